//! The key light.

words! {
    /// Where the light comes from and how it falls.
    Light {
        heading: "Light", "Licht", "Luz", "光照";
        unfold: "Unfold the light", "Licht ausklappen", "Desplegar la luz", "展开光照";
        fold: "Fold the light", "Licht einklappen", "Plegar la luz", "收起光照";
        reset: "Light as ever", "Licht wie immer", "La luz de siempre", "恢复默认光照";
        ball: "Direction of the light", "Richtung des Lichts", "Dirección de la luz", "光的方向";
        ball_hint: "Drag the lamp: the middle is the viewer, the rim a light from behind", "Die Lampe ziehen: Die Mitte ist der Betrachter, der Rand ein Licht von hinten", "Arrastre la lámpara: el centro es quien mira; el borde, una luz desde atrás", "拖动灯：中心为观察者，边缘为来自后方的光";
        side: "Turned", "Gedreht", "Girada", "左右";
        side_hint: "To the right of the viewer; below 0 to the left", "Nach rechts vom Betrachter; unter 0 nach links", "A la derecha de quien mira; por debajo de 0, a la izquierda", "位于观察者右侧的角度；负值为左侧";
        height: "Raised", "Erhoben", "Elevada", "高低";
        height_hint: "Above the viewer; below 0 under", "Über dem Betrachter; unter 0 darunter", "Por encima de quien mira; por debajo de 0, debajo", "高于观察者的角度；负值为低于";
        soft: "Softness", "Weichheit", "Suavidad", "柔和度";
        soft_hint: "Width of the lamp: how soft the edges of shadows are", "Breite der Lampe: wie weich die Ränder der Schatten sind", "Anchura de la lámpara: la suavidad de los bordes de las sombras", "灯的宽度：阴影边缘的柔和程度";
        contact: "Contact", "Kontakt", "Contacto", "接触阴影";
        contact_hint: "How dark creases and cuts are where surfaces meet", "Wie dunkel Falten und Schnitte sind, wo Flächen sich treffen", "La oscuridad de pliegues y cortes donde se encuentran las superficies", "表面相接的褶皱和切口处的暗度";
        skin: "Into skin", "In die Haut", "En la piel", "皮下透光";
        skin_hint: "How far light goes under the surface, as under skin", "Wie weit Licht unter die Oberfläche dringt, wie unter Haut", "Hasta dónde entra la luz bajo la superficie, como bajo la piel", "光进入表面之下的深度，如皮肤之下";
    }
}
