//! The choice of an illustrator's style, and what may be changed of it.

words! {
    /// Styles and their parts.
    Style {
        heading: "Style", "Stil", "Estilo", "风格";
        drawn: "Drawn as", "Gezeichnet", "Como en", "画法";
        drawn_hint: "How an illustrator would draw the picture", "Wie ein Illustrator das Bild zeichnen würde", "Cómo dibujaría la imagen un ilustrador", "插画师会如何绘制此图";
        plain: "Plain", "Schlicht", "Sencillo", "普通";
        plain_hint: "Light and shade alone, without lines", "Nur Licht und Schatten, ohne Linien", "Solo luz y sombra, sin líneas", "仅有明暗，没有线条";
        own: "Own", "Eigener", "Propio", "自定义";
        changed: "{0}, changed", "{0}, angepasst", "{0}, ajustado", "{0}（已调整）";
        atlas_hint: "Fine brown lines, warm light and cool shade", "Feine braune Linien, warmes Licht und kühler Schatten", "Líneas pardas finas, luz cálida y sombra fría", "棕色细线，暖光冷影";
        ink_hint: "Black lines and strokes on white", "Schwarze Linien und Striche auf Weiß", "Líneas y trazos negros sobre blanco", "白底黑色线条与排线";
        pencil_hint: "Soft grey strokes that follow the form", "Weiche graue Striche, die der Form folgen", "Trazos grises suaves que siguen la forma", "顺着形体的柔和灰色排线";
        textbook_hint: "Dark lines and three steps of shade", "Dunkle Linien und drei Stufen von Schatten", "Líneas oscuras y tres grados de sombra", "深色线条与三级明暗";
        blueprint_hint: "White lines and strokes on blue", "Weiße Linien und Striche auf Blau", "Líneas y trazos blancos sobre azul", "蓝底白色线条与排线";
        change: "Change the style", "Stil anpassen", "Ajustar el estilo", "调整风格";
        unfold: "Unfold the style", "Stil ausklappen", "Desplegar el estilo", "展开风格";
        fold: "Fold the style", "Stil einklappen", "Plegar el estilo", "收起风格";
        as_preset: "As the style has it", "Wie im Stil", "Como en el estilo", "与风格一致";
        outline: "Outline", "Umriss", "Contorno", "轮廓线";
        outline_hint: "Width of the lines around what is seen, in thousandths of the picture's shorter side", "Breite der Linien um das, was man sieht, in Tausendsteln der kürzeren Seite des Bildes", "Anchura de las líneas alrededor de lo que se ve, en milésimas del lado menor de la imagen", "可见物体周围线条的宽度，以图像短边的千分之一为单位";
        outline_colour: "Line colour", "Linienfarbe", "Color línea", "轮廓颜色";
        outline_colour_hint: "Colour of the lines", "Farbe der Linien", "Color de las líneas", "轮廓线的颜色";
        creases: "Creases", "Knicke", "Pliegues", "折痕";
        creases_hint: "How readily a crease gets a line: at 0 there are outlines alone", "Wie leicht ein Knick eine Linie bekommt: bei 0 gibt es nur Umrisse", "Con qué facilidad recibe línea un pliegue: con 0 solo hay contornos", "折痕画线的程度：为 0 时只有轮廓";
        tone: "Shading", "Tonwerte", "Sombreado", "明暗";
        tone_hint: "How far the colours of light and shade stand in for plain shading", "Wie weit die Farben von Licht und Schatten an die Stelle schlichter Schattierung treten", "Hasta qué punto los colores de luz y sombra sustituyen al sombreado sencillo", "亮部和暗部颜色取代普通明暗的程度";
        levels: "Shades", "Stufen", "Grados", "色阶";
        levels_hint: "Shading that is smooth, or in so many steps", "Schattierung, die weich ist oder so viele Stufen hat", "Sombreado suave o en tantos grados", "平滑的明暗，或分为若干级";
        smooth: "Smooth", "Weich", "Suave", "平滑";
        warm: "Light", "Licht", "Luz", "亮部";
        warm_hint: "Colour of what is lit", "Farbe dessen, was im Licht liegt", "Color de lo iluminado", "受光处的颜色";
        cool: "Shade", "Schatten", "Sombra", "暗部";
        cool_hint: "Colour of what is in the shade", "Farbe dessen, was im Schatten liegt", "Color de lo que está en sombra", "背光处的颜色";
        hatch: "Hatching", "Schraffur", "Rayado", "排线";
        hatch_hint: "Opacity of strokes over what is in the shade", "Deckkraft von Strichen über dem, was im Schatten liegt", "Opacidad de los trazos sobre lo que está en sombra", "暗部排线的不透明度";
        hatch_spacing: "Stroke gap", "Abstand", "Entre trazos", "线距";
        hatch_spacing_hint: "From one stroke to the next, in thousandths of the picture's shorter side", "Von einem Strich zum nächsten, in Tausendsteln der kürzeren Seite des Bildes", "De un trazo al siguiente, en milésimas del lado menor de la imagen", "相邻排线的间距，以图像短边的千分之一为单位";
        hatch_width: "Stroke", "Strich", "Trazo", "线宽";
        hatch_width_hint: "Width of a stroke, in thousandths of the picture's shorter side", "Breite eines Strichs, in Tausendsteln der kürzeren Seite des Bildes", "Anchura de un trazo, en milésimas del lado menor de la imagen", "排线的宽度，以图像短边的千分之一为单位";
        hatch_by: "Direction", "Richtung", "Dirección", "方向";
        hatch_by_hint: "What the strokes follow", "Wem die Striche folgen", "Qué siguen los trazos", "排线的走向";
        curvature: "Curvature", "Krümmung", "Curvatura", "曲率";
        curvature_hint: "The strokes follow the bend of the surface", "Die Striche folgen der Krümmung der Fläche", "Los trazos siguen la curvatura de la superficie", "排线顺着表面的弯曲";
        axis: "Long axis", "Längsachse", "Eje largo", "长轴";
        axis_hint: "The strokes follow the long axis of what is drawn", "Die Striche folgen der Längsachse dessen, was gezeichnet wird", "Los trazos siguen el eje largo de lo que se dibuja", "排线顺着物体的长轴";
        hatch_colour: "Colour", "Strichfarbe", "Color trazo", "排线颜色";
        hatch_colour_hint: "Colour of the strokes", "Farbe der Striche", "Color de los trazos", "排线的颜色";
        stipple: "Dots", "Punkte", "Puntos", "点画";
        stipple_hint: "Opacity of dots over what is in the shade", "Deckkraft von Punkten über dem, was im Schatten liegt", "Opacidad de los puntos sobre lo que está en sombra", "暗部点画的不透明度";
        stipple_spacing: "Dot gap", "Raster", "Separación", "点距";
        stipple_spacing_hint: "From one dot to the next, in thousandths of the picture's shorter side", "Von einem Punkt zum nächsten, in Tausendsteln der kürzeren Seite des Bildes", "De un punto al siguiente, en milésimas del lado menor de la imagen", "相邻点的间距，以图像短边的千分之一为单位";
        stipple_size: "Dot size", "Punktgröße", "Tamaño", "点径";
        stipple_size_hint: "Diameter of a dot, in thousandths of the picture's shorter side", "Durchmesser eines Punkts, in Tausendsteln der kürzeren Seite des Bildes", "Diámetro de un punto, en milésimas del lado menor de la imagen", "点的直径，以图像短边的千分之一为单位";
        stipple_colour: "Dot colour", "Punktfarbe", "Color punto", "点的颜色";
        stipple_colour_hint: "Colour of the dots", "Farbe der Punkte", "Color de los puntos", "点画的颜色";
        ghost: "Ghosting", "Durchsicht", "Velado", "透视";
        ghost_hint: "How clear tissue in front becomes, while its rims stay", "Wie klar Gewebe davor wird, während seine Ränder bleiben", "Cuánto se aclara el tejido de delante, mientras quedan sus bordes", "前方组织变透明的程度，边缘保留";
        ghost_by: "Ghosted", "Klar wird", "Qué se vela", "透视对象";
        ghost_by_hint: "Which tissue becomes clear", "Welches Gewebe klar wird", "Qué tejido se aclara", "哪些组织变透明";
        facing: "Facing", "Zugewandt", "De frente", "正面";
        facing_hint: "Surfaces that face the eye", "Flächen, die dem Auge zugewandt sind", "Superficies que miran al ojo", "正对视线的表面";
        cut: "Far away", "Entfernt", "Lejano", "远处";
        cut_hint: "What is far from all templates", "Was fern von allen Vorlagen liegt", "Lo que está lejos de todas las plantillas", "远离所有模板的部分";
    }
}
