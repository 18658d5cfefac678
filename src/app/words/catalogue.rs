//! The catalogue of templates.

words! {
    /// The catalogue of template kinds.
    Catalogue {
        open_up: "Open up", "Öffnen", "Abrir", "打开";
        take_apart: "Take apart", "Zerlegen", "Separar", "分开";
        carve: "Carve and shape", "Schnitzen und formen", "Tallar y dar forma", "雕刻与塑形";
        bend: "Bend", "Biegen", "Doblar", "弯曲";
        place: "Place {0}", "{0} platzieren", "Colocar {0}", "放置{0}";
        full: "A document holds at most 32 templates.", "Ein Dokument fasst höchstens 32 Vorlagen.", "Un documento admite como máximo 32 plantillas.", "一个文档最多包含 32 个模板。";
    }
}
