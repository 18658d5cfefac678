//! Shaping a clay.

words! {
    /// Texts of the tool that shapes a clay and of the list of strokes.
    Clay {
        heading: "Strokes", "Striche", "Trazos", "笔划";
        begin: "Shape it as clay", "Als Ton formen", "Modelarlo como arcilla", "作为黏土塑形";
        begin_hint: "A new document begins with a clay of a tissue, or of the outer surface; undo brings this one back", "Ein neues Dokument beginnt mit einem Ton aus einem Gewebe oder aus der äußeren Oberfläche; Rückgängig bringt dieses zurück", "Empieza un documento nuevo con una arcilla de un tejido o de la superficie exterior; deshacer recupera este", "以某个组织或外表面的黏土开始新文档；撤销可恢复当前文档";
        outer: "Outer surface", "Äußere Oberfläche", "Superficie exterior", "外表面";
        begin_mesh_hint: "A new document begins with a clay of this mesh; undo brings this one back", "Ein neues Dokument beginnt mit einem Ton aus diesem Netz; Rückgängig bringt dieses zurück", "Empieza un documento nuevo con una arcilla de esta malla; deshacer recupera este", "以此网格的黏土开始新文档；撤销可恢复当前文档";
        shape: "Shape the clay", "Ton formen", "Modelar la arcilla", "塑形";
        put_away: "Put the tool away", "Werkzeug weglegen", "Guardar el instrumento", "放下器械";
        none: "No stroke yet: take the tool and drag over the clay.", "Noch kein Strich: das Werkzeug nehmen und über den Ton ziehen.", "Aún no hay trazos: tome el instrumento y arrastre sobre la arcilla.", "尚无笔划：拿起器械，在黏土上拖动。";
        way: "What a drag does", "Was das Ziehen bewirkt", "Lo que hace el arrastre", "拖动的作用";
        r#move: "Move", "Ziehen", "Mover", "移动";
        push: "Push, pull", "Drücken, heben", "Empujar, tirar", "推拉";
        along: "Along", "Entlang", "A lo largo", "沿面";
        turn: "Turn", "Drehen", "Girar", "扭转";
        grow: "Grow", "Wachsen", "Crecer", "膨大";
        smooth: "Smooth", "Glätten", "Alisar", "平滑";
        move_hint: "The tool goes with the hand, in the plane of the picture; Shift on the way keeps it to one axis", "Das Werkzeug geht mit der Hand, in der Bildebene; Umschalt unterwegs hält es auf einer Achse", "El instrumento sigue a la mano, en el plano de la imagen; Mayús por el camino lo mantiene en un eje", "器械在图像平面内随手移动；途中按 Shift 使其保持单轴";
        push_hint: "Up pulls out of the surface, down pushes into it", "Nach oben hebt aus der Fläche, nach unten drückt hinein", "Hacia arriba tira de la superficie, hacia abajo la hunde", "向上拉出表面，向下压入";
        along_hint: "The tool follows the surface under the hand", "Das Werkzeug folgt der Fläche unter der Hand", "El instrumento sigue la superficie bajo la mano", "器械沿手下的表面移动";
        turn_hint: "Sideways turns the tool about the surface's normal", "Seitwärts dreht das Werkzeug um die Flächennormale", "De lado gira el instrumento sobre la normal de la superficie", "左右拖动使器械绕表面法线旋转";
        grow_hint: "Up makes the tool grow and what is in it, down makes it shrink", "Nach oben wächst das Werkzeug und was in ihm ist, nach unten schrumpft es", "Hacia arriba crece el instrumento y lo que contiene, hacia abajo encoge", "向上使器械及其中部分变大，向下变小";
        smooth_hint: "What is under the hand is smoothed; with Shift held any drag does", "Was unter der Hand ist, wird geglättet; mit Umschalt tut es jedes Ziehen", "Alisa lo que está bajo la mano; con Mayús lo hace cualquier arrastre", "平滑手下的部分；按住 Shift 时任何拖动皆如此";
        place: "Place", "Hinlegen", "Colocar", "放置";
        place_hint: "A click lays the tool down; its handles, or the arrow keys, move it, turn it (T) and size it (S). With “Together” it holds what is in it until it is moved", "Ein Klick legt das Werkzeug hin; seine Griffe oder die Pfeiltasten bewegen, drehen (T) und vergrößern (S) es. Mit „Gemeinsam“ hält es, was in ihm ist, bis es bewegt wird", "Un clic deja el instrumento; sus tiradores o las flechas lo mueven, lo giran (T) y cambian su tamaño (S). Con «A la vez» sujeta lo que contiene hasta que se mueve", "单击放下器械；用手柄或方向键移动、旋转 (T)、缩放 (S)。启用“同时”时，移动前固定其中的部分";
        acts: "Handles act", "Griffe wirken", "Los tiradores actúan", "手柄起作用";
        acts_hint: "Handles act: each drag of one shapes the clay by the tool on its way; otherwise they only place it", "Griffe wirken: jedes Ziehen formt den Ton mit dem Werkzeug auf seinem Weg; sonst legen sie es nur zurecht", "Los tiradores actúan: cada arrastre modela la arcilla con el instrumento por su camino; si no, solo lo colocan", "手柄起作用：每次拖动都让器械沿途塑形；否则只摆放器械";
        form: "Form of the tool", "Form des Werkzeugs", "Forma del instrumento", "器械的形状";
        draw_form: "Draw the form…", "Form zeichnen…", "Dibujar la forma…", "绘制形状…";
        draw_form_hint: "The next drag over the picture draws a curve, which becomes the tool in the hand", "Der nächste Zug über das Bild zeichnet eine Kurve, die das Werkzeug in der Hand wird", "El próximo arrastre sobre la imagen dibuja una curva, que será el instrumento en la mano", "下一次在图像上拖动画出的曲线将成为手中的器械";
        bake: "Bake the clay", "Ton backen", "Cocer la arcilla", "烘焙黏土";
        bake_hint: "The clay as it stands becomes a tool in the hand", "Der Ton, wie er jetzt ist, wird ein Werkzeug in der Hand", "La arcilla tal como está se vuelve un instrumento en la mano", "当前的黏土成为手中的器械";
        size: "Size", "Größe", "Tamaño", "大小";
        size_hint: "Half the length of the tool; [ and ], or F held and the pointer or the wheel", "Halbe Länge des Werkzeugs; [ und ] oder F halten und Zeiger oder Rad bewegen", "Mitad de la longitud del instrumento; [ y ], o F pulsada y el puntero o la rueda", "器械长度的一半；[ 和 ]，或按住 F 移动指针或滚动滚轮";
        coat: "Coating", "Mantel", "Recubrimiento", "影响层";
        coat_hint: "Width around the tool in which the motion fades; as the size, with Shift and F", "Breite um das Werkzeug, in der die Bewegung abklingt; wie die Größe, mit Umschalt und F", "Anchura en torno al instrumento en que el movimiento se atenúa; como el tamaño, con Mayús y F", "器械周围运动逐渐减弱的宽度；同大小，用 Shift 和 F";
        depth: "Depth", "Tiefe", "Profundidad", "深度";
        depth_hint: "How deep the tool is sunk where the drag begins: 0 % by half. A pen sinks it deeper by pressing harder", "Wie tief das Werkzeug am Anfang des Zuges steckt: 0 % zur Hälfte. Ein Stift senkt es tiefer, wenn er stärker drückt", "Cuánto se hunde el instrumento al empezar: 0 % hasta la mitad. Un lápiz lo hunde más si presiona más", "拖动开始时器械陷入的深度：0 % 为一半。触控笔压得越重，陷入越深";
        angle: "Angle", "Winkel", "Ángulo", "角度";
        angle_hint: "Turn of the tool about the surface's normal; R held and the pointer", "Drehung des Werkzeugs um die Flächennormale; R halten und Zeiger bewegen", "Giro del instrumento sobre la normal de la superficie; R pulsada y el puntero", "器械绕表面法线的转角；按住 R 移动指针";
        smaller: "Smaller tool", "Kleineres Werkzeug", "Instrumento menor", "缩小器械";
        larger: "Larger tool", "Größeres Werkzeug", "Instrumento mayor", "放大器械";
        mirror: "Mirror across {0}", "Spiegeln quer zu {0}", "Espejo en {0}", "沿 {0} 镜像";
        mirrors: "Mirror", "Spiegeln", "Espejo", "镜像";
        mirror_hint: "The tool has an image beyond the middle of the object, which acts at the same time", "Das Werkzeug hat ein Spiegelbild jenseits der Mitte des Objekts, das gleichzeitig wirkt", "El instrumento tiene una imagen reflejada más allá del centro del objeto, que actúa a la vez", "器械在对象中面另一侧有镜像，同时作用";
        shown: "Shown", "Gezeigt", "Mostrados", "显示";
        shown_hint: "As many strokes are shown, the first ones; steps can let the clay grow by them", "So viele Striche werden gezeigt, die ersten; Schritte können den Ton damit wachsen lassen", "Se muestran tantos trazos, los primeros; los pasos pueden hacer crecer la arcilla con ellos", "显示最前面的这些笔划；步骤可使黏土随之成形";
        show_all_first: "Strokes are drawn where all of them are shown: put “Shown” to the end first", "Striche zeichnet man, wo alle gezeigt werden: zuerst „Gezeigt“ ans Ende stellen", "Los trazos se dibujan donde se muestran todos: lleve antes «Mostrados» al final", "须显示全部笔划才能绘制：先把“显示”调到最后";
        too_many_tools: "A clay has at most {0} different tools; choose one of those that its strokes use", "Ein Ton hat höchstens {0} verschiedene Werkzeuge; bitte eines wählen, das seine Striche verwenden", "Una arcilla tiene como máximo {0} instrumentos distintos; elija uno de los que usan sus trazos", "一块黏土最多有 {0} 种器械；请选用其笔划已用的一种";
        stroke: "Stroke {0}", "Strich {0}", "Trazo {0}", "笔划 {0}";
        later: "Move stroke {0} up: it acts later", "Strich {0} nach oben: wirkt später", "Subir el trazo {0}: actúa después", "上移笔划 {0}：更晚起效";
        earlier: "Move stroke {0} down: it acts earlier", "Strich {0} nach unten: wirkt früher", "Bajar el trazo {0}: actúa antes", "下移笔划 {0}：更早起效";
        remove: "Remove stroke {0}", "Strich {0} entfernen", "Quitar el trazo {0}", "移除笔划 {0}";
        swept: "moves", "bewegt", "mueve", "移动";
        smoothed: "smooths", "glättet", "alisa", "平滑";
        detail: "Detail", "Feinheit", "Detalle", "细节";
        detail_hint: "Longest edge of the clay's triangles where strokes come; a change does all strokes again", "Längste Kante der Dreiecke, wo Striche hinkommen; eine Änderung macht alle Striche neu", "Arista más larga de los triángulos donde llegan los trazos; un cambio repite todos los trazos", "笔划所及处三角形的最长边；更改会重做全部笔划";
        ball: "Ball of clay", "Tonkugel", "Bola de arcilla", "黏土球";
        cube: "Block of clay", "Tonwürfel", "Bloque de arcilla", "黏土块";
        plate: "Plate of clay", "Tonplatte", "Placa de arcilla", "黏土板";
        torus: "Ring of clay", "Tonring", "Anillo de arcilla", "黏土环";
        key_size: "F held with a tool", "F halten mit Werkzeug", "F pulsada con un instrumento", "持器械时按住 F";
        key_size_does: "Size the tool; with Shift its coating", "Größe des Werkzeugs; mit Umschalt der Mantel", "Tamaño del instrumento; con Mayús el recubrimiento", "调整器械大小；加 Shift 调影响层";
        key_turn: "R held with a tool", "R halten mit Werkzeug", "R pulsada con un instrumento", "持器械时按住 R";
        key_turn_does: "Turn the tool", "Werkzeug drehen", "Girar el instrumento", "转动器械";
        key_act: "Enter over clay", "Eingabe über Ton", "Intro sobre arcilla", "在黏土上按回车";
        key_together: "Lay strokes on clay down, or do them again", "Striche auf Ton vormerken oder wieder ausführen", "Dejar previstos los trazos sobre arcilla, o volver a hacerlos", "预置黏土笔划，或恢复直接执行";
        together: "Together", "Gemeinsam", "A la vez", "同时";
        together_hint: "Together (J): strokes are only laid down until Enter does them as one; Escape drops them, Undo takes the last one back. Smoothing is done at once", "Gemeinsam (J): Striche werden nur vorgemerkt, bis die Eingabetaste sie als einen ausführt; Esc verwirft sie, Rückgängig nimmt den letzten zurück. Geglättet wird sofort", "A la vez (J): los trazos solo se prevén hasta que Intro los hace como uno; Esc los descarta, Deshacer retira el último. El alisado se hace al momento", "同时 (J)：笔划只是预置，按回车时合为一笔执行；Esc 全部放弃，撤销收回最后一笔。平滑则立即执行";
        act: "Do what is laid down as one stroke", "Vorgemerktes als einen Strich ausführen", "Hacer lo previsto como un solo trazo", "把预置的合为一笔执行";
        take_back: "Take back what was laid down last", "Zuletzt Vorgemerktes zurücknehmen", "Retirar lo último previsto", "收回最后预置的";
        too_many_at_once: "At most {0} tools act at once, mirror images counted", "Höchstens {0} Werkzeuge wirken gleichzeitig, Spiegelbilder mitgezählt", "Como máximo actúan {0} instrumentos a la vez, contando las imágenes reflejadas", "最多 {0} 件器械同时作用，镜像计入";
        drag: "Drag over the clay; beside it turns the view", "Über den Ton ziehen; daneben dreht es die Ansicht", "Arrastre sobre la arcilla; al lado gira la vista", "在黏土上拖动；旁边则转动视图";
    }
}
