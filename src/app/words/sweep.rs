//! Tools of a sweep, their shapes and paths.

words! {
    /// Texts of tools and their paths.
    Sweep {
        tools: "Tools", "Werkzeuge", "Instrumentos", "器械";
        tools_hint: "They act at once, each along its own path", "Sie wirken gleichzeitig, jedes auf seinem Weg", "Actúan a la vez, cada uno por su recorrido", "它们同时作用，各沿自己的路径";
        in_hand: "Tool in hand", "Werkzeug in der Hand", "Instrumento en la mano", "手中的器械";
        add: "Add a tool", "Werkzeug hinzufügen", "Añadir un instrumento", "添加器械";
        remove: "Remove tool {0}", "Werkzeug {0} entfernen", "Quitar el instrumento {0}", "移除器械 {0}";
        tool: "Tool {0}", "Werkzeug {0}", "Instrumento {0}", "器械 {0}";
        shape_hint: "Form of the tool", "Form des Werkzeugs", "Forma del instrumento", "器械的形状";
        unknown: "This version does not draw a tool of this shape; it is kept.", "Ein Werkzeug dieser Form zeichnet diese Version nicht; es bleibt erhalten.", "Esta versión no dibuja un instrumento de esta forma; se conserva.", "此版本不绘制这种形状的器械；它会被保留。";
        ball: "Ball", "Kugel", "Bola", "球";
        ellipsoid: "Ellipsoid", "Ellipsoid", "Elipsoide", "椭球";
        capsule: "Rod", "Stab", "Varilla", "杆";
        block: "Block", "Klotz", "Bloque", "块";
        torus: "Ring", "Ring", "Anillo", "环";
        curve: "Curve", "Kurve", "Curva", "曲线";
        mesh: "Mesh", "Netz", "Malla", "网格";
        baked: "Baked clay", "Gebackener Ton", "Arcilla cocida", "烘焙的黏土";
        longest: "Longest side", "Längste Seite", "Lado más largo", "最长边";
        radius: "Radius", "Radius", "Radio", "半径";
        radii: "Half axes", "Halbachsen", "Semiejes", "半轴";
        length: "Length", "Länge", "Longitud", "长度";
        half: "Half sides", "Halbe Seiten", "Semilados", "半边长";
        round: "Rounding", "Rundung", "Redondeo", "圆角";
        ring: "Ring radius", "Ringradius", "Radio del anillo", "环半径";
        size_hint: "A part of the shortest side of the box", "Ein Teil der kürzesten Seite des Quaders", "Una parte del lado más corto de la caja", "盒子最短边的比例";
        coat: "Coating", "Mantel", "Recubrimiento", "影响层";
        coat_hint: "Width in which the motion fades, a part of the shortest side of the box", "Breite, in der die Bewegung abklingt, ein Teil der kürzesten Seite des Quaders", "Anchura en que el movimiento se atenúa, una parte del lado más corto de la caja", "运动逐渐减弱的宽度，盒子最短边的比例";
        smooth: "Smooth path", "Glatter Weg", "Recorrido suave", "平滑路径";
        smooth_hint: "With three keys or more: a curve through them instead of one straight or turning piece from key to key", "Ab drei Stellen: eine Kurve durch sie statt gerader oder gedrehter Stücke von Stelle zu Stelle", "Con tres puntos o más: una curva por ellos en lugar de tramos rectos o con giro", "三个关键点以上：以曲线连接，而非逐段直行或旋转";
        key: "Key {0}", "Stelle {0}", "Punto {0}", "关键点 {0}";
        key_hint: "Where the tool is, parts of the box; on its way it passes its keys in turn", "Wo das Werkzeug ist, Teile des Quaders; auf dem Weg kommt es der Reihe nach an seine Stellen", "Dónde está el instrumento, partes de la caja; pasa por sus puntos uno tras otro", "器械的位置，盒子的比例；依次经过各关键点";
        key_add: "Add a key to tool {0}", "Stelle zu Werkzeug {0} hinzufügen", "Añadir un punto al instrumento {0}", "为器械 {0} 添加关键点";
        click_or_draw: "Click where the tool presses, or draw its way on the object", "Klicken, wo das Werkzeug drückt, oder seinen Weg auf dem Objekt ziehen", "Haga clic donde presiona el instrumento o dibuje su recorrido en el objeto", "点击器械按压的位置，或在对象上画出其路径";
        tap_or_draw: "Tap, or draw the tool's way", "Tippen oder den Weg des Werkzeugs ziehen", "Toque o dibuje el recorrido", "点按，或画出器械的路径";
        key_of: "Key {0} of tool {1}", "Stelle {0} von Werkzeug {1}", "Punto {0} del instrumento {1}", "器械 {1} 的关键点 {0}";
        key_remove: "Remove key {0} of tool {1}", "Stelle {0} von Werkzeug {1} entfernen", "Quitar el punto {0} del instrumento {1}", "移除器械 {1} 的关键点 {0}";
        turn: "Turned", "Gedreht", "Giro", "旋转";
        turn_hint: "Turn of the tool at this key", "Drehung des Werkzeugs an dieser Stelle", "Giro del instrumento en este punto", "器械在此关键点的旋转";
        scale: "Scale", "Größe", "Escala", "缩放";
        scale_hint: "Times its size; what is in it grows along", "Vielfaches seiner Größe; was in ihm ist, wächst mit", "Múltiplo de su tamaño; lo que hay dentro crece con él", "其大小的倍数；其中的组织随之增大";
        join: "Put its tools into template {0}", "Werkzeuge in Vorlage {0} übernehmen", "Pasar sus instrumentos a la plantilla {0}", "将其器械并入模板 {0}";
        join_hint: "The tools of one sweep act at once and never fold tissue, which two that are summed may", "Die Werkzeuge einer einzigen Vorlage wirken gleichzeitig und falten nie Gewebe, was zwei summierte können", "Los instrumentos de una sola plantilla actúan a la vez y nunca pliegan el tejido, como pueden hacerlo dos sumadas", "同一模板的器械同时作用，绝不会使组织折叠；两个相加的模板则可能";
        mirror: "Mirror", "Spiegeln", "Espejo", "镜像";
        mirror_hint: "Every tool has an image beyond the middle of the box, which acts at the same time", "Jedes Werkzeug hat ein Spiegelbild jenseits der Mitte des Quaders, das gleichzeitig wirkt", "Cada instrumento tiene una imagen reflejada más allá del centro de la caja, que actúa a la vez", "每个器械在盒子中面另一侧有镜像，同时作用";
        mirror_axis: "Mirror across {0}", "Spiegeln quer zu {0}", "Espejo en {0}", "沿 {0} 镜像";
    }
}
