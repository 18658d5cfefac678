//! The steps of a lesson: recording and playing them.

words! {
    /// Recording and playing the steps of a lesson.
    Steps {
        heading: "Steps", "Schritte", "Pasos", "步骤";
        none: "Steps make a lesson: each one keeps what differs from the one before. Pose the scene, add a step, and change what it is to show.", "Schritte machen eine Lektion: Jeder behält, was anders ist als davor. Szene stellen, Schritt hinzufügen und ändern, was er zeigen soll.", "Los pasos forman una lección: cada uno guarda lo que cambia respecto al anterior. Componga la escena, añada un paso y cambie lo que debe mostrar.", "步骤组成课程：每一步只保存与上一步的不同。摆好场景，添加一步，再修改该步要显示的内容。";
        add: "Add step", "Schritt hinzufügen", "Añadir paso", "添加步骤";
        add_hint: "Add a step after this one; what you change then is what it shows", "Nach diesem einen Schritt hinzufügen; was Sie dann ändern, zeigt er", "Añadir un paso después de este; lo que cambie entonces es lo que mostrará", "在此步之后添加一步；随后的修改即为该步所示";
        duplicate: "Duplicate the step", "Schritt verdoppeln", "Duplicar el paso", "复制此步";
        delete: "Delete the step", "Schritt löschen", "Eliminar el paso", "删除此步";
        earlier: "Show the step earlier", "Schritt früher zeigen", "Mostrar el paso antes", "将此步前移";
        later: "Show the step later", "Schritt später zeigen", "Mostrar el paso después", "将此步后移";
        update: "Take the present view", "Jetzige Ansicht übernehmen", "Tomar la vista actual", "采用当前视角";
        update_hint: "Update the step from now: it looks from where you look now", "Den Schritt von jetzt übernehmen: Er blickt von da, wo Sie jetzt hinsehen", "Actualizar el paso con lo actual: mira desde donde usted mira ahora", "用当前状态更新此步：从您现在的视角观看";
        play: "Play", "Abspielen", "Reproducir", "播放";
        stop: "Stop", "Anhalten", "Detener", "停止";
        scrub: "Place in the lesson", "Stelle in der Lektion", "Lugar en la lección", "课程位置";
        start: "Start", "Anfang", "Inicio", "起始";
        step_n: "Step {0}", "Schritt {0}", "Paso {0}", "第 {0} 步";
        title: "Title of the step", "Titel des Schritts", "Título del paso", "此步标题";
        title_hint: "Incision", "Schnitt", "Incisión", "切口";
        caption: "Caption of the step", "Bildtext des Schritts", "Leyenda del paso", "此步说明";
        caption_hint: "What this step shows", "Was dieser Schritt zeigt", "Lo que muestra este paso", "此步所示内容";
        seconds: "Passage", "Übergang", "Transición", "过渡";
        seconds_hint: "How long the way to this step takes", "Wie lange der Weg zu diesem Schritt dauert", "Cuánto dura el paso hasta aquí", "到达此步所需的时间";
        hold: "Stay", "Bleiben", "Permanecer", "停留";
        hold_hint: "How long the lesson stays here when it plays by itself", "Wie lange die Lektion hier bleibt, wenn sie von selbst läuft", "Cuánto permanece aquí la lección cuando se reproduce sola", "自动播放时在此停留的时间";
        notes: "Notes for the teacher", "Notizen für die Lehrperson", "Notas para el docente", "教师备注";
        notes_hint: "What to say here", "Was hier zu sagen ist", "Lo que hay que decir aquí", "此处要讲的内容";
        notes_are_in_link: "Notes are not shown, but they are in the link and in the file: whoever has them can read them.", "Notizen werden nicht gezeigt, stehen aber im Link und in der Datei: Wer sie hat, kann sie lesen.", "Las notas no se muestran, pero están en el enlace y en el archivo: quien los tenga puede leerlas.", "备注不会显示，但包含在链接和文件中：持有者可以读到。";
        edits_here: "What you change now is what step {0} shows, until a later step changes it.", "Was Sie jetzt ändern, zeigt Schritt {0}, bis ein späterer Schritt es ändert.", "Lo que cambie ahora es lo que muestra el paso {0}, hasta que otro posterior lo cambie.", "现在的修改即为第 {0} 步所示，直到后面的步骤再作修改。";
        order_for_all: "The order of templates holds for all steps", "Die Reihenfolge der Vorlagen gilt für alle Schritte", "El orden de las plantillas vale para todos los pasos", "模板的顺序适用于所有步骤";
        hidden_from_here: "Switched off from this step on; the steps before still show it", "Ab diesem Schritt ausgeschaltet; die Schritte davor zeigen es noch", "Desactivado desde este paso; los anteriores aún lo muestran", "从此步起关闭；之前的步骤仍显示";
        show_caption: "Show the label", "Beschriftung zeigen", "Mostrar el rótulo", "显示标注";
        hide_caption: "Hide the label", "Beschriftung ausblenden", "Ocultar el rótulo", "隐藏标注";
    }
}
