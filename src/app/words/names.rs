//! Names that lower rooms give in English: subjects, presets, steps of undo, the work of a loader. A name that
//! is not known here stays English.

use super::{Lang, bar, capitalized, figure, fill, kinds, lang, of};
use crate::document::figure::{Handle, Hold};
use crate::document::{Illustration, PlacedTemplate, SubjectRef, TemplateKind, ToolShape};

words! {
    /// What a step of undo did.
    Names {
        add: "Add {0}", "{0} hinzufügen", "Añadir {0}", "添加{0}";
        remove: "Remove {0}", "{0} entfernen", "Quitar {0}", "移除{0}";
        duplicate: "Duplicate {0}", "{0} verdoppeln", "Duplicar {0}", "复制{0}";
        reorder: "Reorder {0}", "{0} umordnen", "Reordenar {0}", "调整{0}的顺序";
        change: "Change {0}", "{0} ändern", "Cambiar {0}", "更改{0}";
        change_of: "Change {0} of {1}", "{0} von {1} ändern", "Cambiar {0} de {1}", "更改{1}的{0}";
        r#move: "Move {0}", "{0} verschieben", "Mover {0}", "移动{0}";
        turn: "Turn {0}", "{0} drehen", "Girar {0}", "旋转{0}";
        resize: "Resize {0}", "Größe von {0} ändern", "Cambiar el tamaño de {0}", "缩放{0}";
        place: "Place {0}", "{0} platzieren", "Colocar {0}", "放置{0}";
        show: "Show {0}", "{0} einblenden", "Mostrar {0}", "显示{0}";
        hide: "Hide {0}", "{0} ausblenden", "Ocultar {0}", "隐藏{0}";
        group: "Group {0}", "{0} gruppieren", "Agrupar {0}", "编组{0}";
        ungroup: "Ungroup {0}", "{0} aus der Gruppe nehmen", "Desagrupar {0}", "取消编组{0}";
        group_named: "group {0}", "Gruppe {0}", "grupo {0}", "组{0}";
        make: "Make {0}", "{0} anlegen", "Crear {0}", "创建{0}";
        rename: "Rename {0}", "{0} umbenennen", "Cambiar el nombre de {0}", "重命名{0}";
        mode: "mode", "Wirkung", "el modo", "组合方式";
        alignment: "alignment", "Ausrichtung", "la alineación", "对齐";
        amount: "amount", "Anteil", "la cantidad", "程度";
        colour: "colour", "Farbe", "el color", "颜色";
        inside: "inside colour", "Farbe innen", "el color interior", "内侧颜色";
        opacity: "opacity", "Deckkraft", "la opacidad", "不透明度";
        gloss: "gloss", "Glanz", "el brillo", "光泽";
    }
}

/// What a built-in subject is called.
pub(crate) fn subject(name: &str) -> String {
    match crate::describe::subject(name) {
        Some(line) => of(line).to_owned(),
        None => capitalized(name),
    }
}

/// What a preset is called, by its name and its English title.
pub(crate) fn preset(name: &str, title: &'static str) -> &'static str {
    of(match name {
        "tissue" => [title, "Gewebe", "Tejido", "组织"],
        "tissue-and-lungs" => [title, "Gewebe und Lunge", "Tejido y pulmones", "组织与肺"],
        "ct-soft-tissue" => [title, "CT Weichteile", "TC partes blandas", "CT 软组织"],
        "ct-skin" => [title, "CT Haut", "TC piel", "CT 皮肤"],
        "ct-bone" => [title, "CT Knochen", "TC hueso", "CT 骨骼"],
        "ct-muscle-bone" => [
            title,
            "CT Muskel und Knochen",
            "TC músculo y hueso",
            "CT 肌肉与骨骼",
        ],
        "ct-skin-glass" => [
            title,
            "CT Haut wie Glas, Knochen",
            "TC piel como vidrio, hueso",
            "CT 透明皮肤、骨骼",
        ],
        "mri" => [title, "MRT", "RM", "MRI"],
        "mri-glass" => [title, "MRT, zart", "RM, tenue", "MRI，淡"],
        _ => return title,
    })
}

/// What a style is called, by its name and its English title.
pub(crate) fn style_preset(name: &str, title: &'static str) -> &'static str {
    of(match name {
        "atlas" => [title, "Atlas", "Atlas", "图谱"],
        "ink" => [title, "Tusche", "Tinta", "墨线"],
        "pencil" => [title, "Bleistift", "Lápiz", "铅笔"],
        "textbook" => [title, "Lehrbuch", "Libro de texto", "教科书"],
        "blueprint" => [title, "Blaupause", "Cianotipo", "蓝图"],
        _ => return title,
    })
}

/// What a loader is at.
pub(crate) fn stage(what: &str) -> String {
    let line = match what {
        "Loading" => ["Loading", "Laden", "Cargando", "正在载入"],
        "Shaping" => ["Shaping", "Formen", "Modelando", "正在塑形"],
        "Reading" => ["Reading", "Lesen", "Leyendo", "正在读取"],
        "Generating" => ["Generating", "Erzeugen", "Generando", "正在生成"],
        "Fetching" => ["Fetching", "Abrufen", "Descargando", "正在获取"],
        _ => return what.to_owned(),
    };
    of(line).to_owned()
}

/// A step of undo, which the document names in English: a verb and what it was done to.
pub(crate) fn edit_title(name: &str) -> String {
    if matches!(lang(), Lang::English | Lang::Mirrored) {
        return name.to_owned();
    }
    let whole = match name {
        "Change colours" => ["", "Farben ändern", "Cambiar los colores", "更改颜色"],
        "Change edges" => ["", "Kanten ändern", "Cambiar los bordes", "更改边缘"],
        "Change letters of sides" => [
            "",
            "Buchstaben der Seiten ändern",
            "Cambiar las letras de los lados",
            "更改方位字母",
        ],
        "Change scale bar" => [
            "",
            "Maßstab ändern",
            "Cambiar la barra de escala",
            "更改比例尺",
        ],
        "Change style" => ["", "Stil ändern", "Cambiar el estilo", "更改风格"],
        "Change tint" => ["", "Tönung ändern", "Cambiar el tinte", "更改着色"],
        "Change window" => ["", "Fenster ändern", "Cambiar la ventana", "更改窗口"],
        "Change opacity mode" => [
            "",
            "Deckkraft ändern",
            "Cambiar la opacidad",
            "更改不透明度",
        ],
        "Change background" => ["", "Hintergrund ändern", "Cambiar el fondo", "更改背景"],
        "Turn the view" => ["", "Ansicht drehen", "Girar la vista", "转动视图"],
        "Change title" => ["", "Titel ändern", "Cambiar el título", "更改标题"],
        "Change caption" => ["", "Bildtext ändern", "Cambiar la leyenda", "更改说明"],
        "Change controls" => ["", "Regler ändern", "Cambiar los controles", "更改控件"],
        "Change credit" => ["", "Nachweis ändern", "Cambiar los créditos", "更改署名"],
        "Change language" => ["", "Sprache ändern", "Cambiar el idioma", "更改语言"],
        "Change subject" => ["", "Objekt ändern", "Cambiar el objeto", "更改对象"],
        "New document" => ["", "Neues Dokument", "Documento nuevo", "新建文档"],
        "Keep templates" => [
            "",
            "Vorlagen behalten",
            "Conservar las plantillas",
            "保留模板",
        ],
        "Paste templates" => ["", "Vorlagen einfügen", "Pegar plantillas", "粘贴模板"],
        "Cut templates" => ["", "Vorlagen ausschneiden", "Cortar plantillas", "剪切模板"],
        "Mirror templates" => ["", "Vorlagen spiegeln", "Reflejar plantillas", "镜像模板"],
        "Group templates" => ["", "Vorlagen gruppieren", "Agrupar plantillas", "编组模板"],
        "Snap to the surface" => [
            "",
            "An die Oberfläche anlegen",
            "Ajustar a la superficie",
            "贴合到表面",
        ],
        "Add label" => ["", "Beschriftung hinzufügen", "Añadir rótulo", "添加标注"],
        "Change label" => ["", "Beschriftung ändern", "Cambiar rótulo", "更改标注"],
        "Remove label" => ["", "Beschriftung entfernen", "Quitar rótulo", "移除标注"],
        "Add mesh" => ["", "Netz hinzufügen", "Añadir malla", "添加网格"],
        "Remove mesh" => ["", "Netz entfernen", "Quitar malla", "移除网格"],
        "Change bodies" => ["", "Körper ändern", "Cambiar los cuerpos", "更改实体"],
        "Change inside colour" => [
            "",
            "Farbe innen ändern",
            "Cambiar el color interior",
            "更改内侧颜色",
        ],
        "Change gloss" => ["", "Glanz ändern", "Cambiar el brillo", "更改光泽"],
        "Change thickness" => ["", "Dicke ändern", "Cambiar el grosor", "更改厚度"],
        "Add layer" => ["", "Schicht hinzufügen", "Añadir capa", "添加层"],
        "Remove layer" => ["", "Schicht entfernen", "Quitar capa", "移除层"],
        "Change layer" => ["", "Schicht ändern", "Cambiar capa", "更改层"],
        "Add object" => ["", "Gegenstand hinzufügen", "Añadir objeto", "添加物体"],
        "Add step" => ["", "Schritt hinzufügen", "Añadir paso", "添加步骤"],
        "Remove step" => ["", "Schritt entfernen", "Quitar paso", "移除步骤"],
        "Add handle" => ["", "Griff hinzufügen", "Añadir asa", "添加控制柄"],
        "Change handle" => ["", "Griff ändern", "Cambiar el asa", "更改控制柄"],
        "Move handles" => ["", "Griffe ziehen", "Mover asas", "移动控制柄"],
        "Turn handles" => ["", "Griffe drehen", "Girar asas", "旋转控制柄"],
        "Put handles back" => ["", "Griffe zurück", "Asas en reposo", "控制柄复位"],
        "Remove handle" => ["", "Griff löschen", "Quitar el asa", "移除控制柄"],
        "Add region" => ["", "Bereich hinzufügen", "Añadir región", "添加区域"],
        "Change region" => ["", "Bereich ändern", "Cambiar la región", "更改区域"],
        "Remove region" => ["", "Bereich löschen", "Quitar la región", "移除区域"],
        "Reorder regions" => [
            "",
            "Bereiche umordnen",
            "Reordenar regiones",
            "调整区域顺序",
        ],
        "Add contour" => ["", "Umriss übernehmen", "Tomar contorno", "采用轮廓"],
        "Remove contour" => ["", "Umriss entfernen", "Quitar contorno", "移除轮廓"],
        "Take all shapes" => ["", "Alle Formen", "Todas las formas", "全部形状"],
        "Add landmark" => ["", "Landmarke hinzufügen", "Añadir punto", "添加标志点"],
        "Change figure" => ["", "Figur ändern", "Cambiar la figura", "更改图形"],
        "Reorder steps" => ["", "Schritte umordnen", "Reordenar pasos", "调整步骤顺序"],
        _ => [""; Lang::COUNT],
    };
    if !of(whole).is_empty() {
        return of(whole).to_owned();
    }
    let Some((verb, rest)) = name.split_once(' ') else {
        return name.to_owned();
    };
    let kind = |name: &str| TemplateKind::from_name(name);
    let w = w();
    let title = |name: &str| match (kind(name), name.strip_prefix("group ")) {
        (Some(kind), _) => kinds::title(kind).to_owned(),
        (None, Some(group)) => fill(w.group_named, &[&group]),
        (None, None) => name.to_owned(),
    };
    let text = match verb {
        "Add" => w.add,
        "Remove" => w.remove,
        "Duplicate" => w.duplicate,
        "Reorder" => w.reorder,
        "Move" => w.r#move,
        "Turn" => w.turn,
        "Resize" => w.resize,
        "Place" => w.place,
        "Show" => w.show,
        "Hide" => w.hide,
        "Make" => w.make,
        "Rename" => w.rename,
        "Group" => w.group,
        "Ungroup" => w.ungroup,
        "Change" => {
            let Some((what, of_what)) = rest.split_once(" of ") else {
                return fill(w.change, &[&rest]);
            };
            let param = kind(of_what).and_then(|kind| {
                let params = kind.spec().params;
                let index = params.iter().position(|param| param.name == what)?;
                Some(kinds::param_name(kind, index))
            });
            let what = match what {
                "mode" => w.mode,
                "alignment" => w.alignment,
                "amount" if param.is_none() => w.amount,
                "colour" => w.colour,
                "inside colour" => w.inside,
                "opacity" => w.opacity,
                "gloss" => w.gloss,
                "object" => super::objects::w().one,
                "constraint" => super::kept::w().constraint,
                _ => param.unwrap_or(what),
            };
            return fill(w.change_of, &[&what, &title(of_what)]);
        }
        _ => return name.to_owned(),
    };
    fill(text, &[&title(rest)])
}

/// What a document's subject is called.
pub(crate) fn subject_title(shown: &Illustration) -> String {
    let w = bar::w();
    let [from_address, own] = match shown.is_of_figure() {
        true => [w.picture_from_address, w.own_picture],
        false => [w.scan_from_address, w.own_scan],
    };
    let or = |name: &str, otherwise: &str| {
        if name.is_empty() {
            otherwise.to_owned()
        } else {
            name.to_owned()
        }
    };
    match &shown.subject {
        SubjectRef::Builtin { name, .. } => subject(name),
        SubjectRef::Address { name, .. } => or(name, from_address),
        SubjectRef::Supplied { name, .. } => or(name, own),
        SubjectRef::Meshes { meshes, .. } => match meshes.as_slice() {
            [one] => or(&one.name, w.own_surface),
            _ => w.own_surfaces.to_owned(),
        },
        SubjectRef::Clay(_) => w.clay.to_owned(),
    }
}

/// The author's name for a handle of a figure, else its kind and number.
pub(crate) fn handle(index: usize, handle: &Handle) -> String {
    let w = figure::w();
    match (&handle.name, &handle.hold) {
        (Some(name), _) if !name.is_empty() => name.clone(),
        (_, Hold::Region(region)) => region.clone(),
        (_, Hold::Point(_)) => fill(w.pin_n, &[&(index + 1)]),
        (_, Hold::Line { .. }) => fill(w.line_n, &[&(index + 1)]),
    }
}

/// The author's name for a template, else the name of its kind.
pub(crate) fn template_title(template: &PlacedTemplate) -> String {
    if template.name.is_empty() {
        kinds::title(template.kind).to_owned()
    } else {
        template.name.clone()
    }
}

/// What the form of a tool is called.
pub(crate) fn tool_shape(shape: &ToolShape) -> &'static str {
    let w = super::sweep::w();
    match shape {
        ToolShape::Ball { .. } => w.ball,
        ToolShape::Ellipsoid { .. } => w.ellipsoid,
        ToolShape::Capsule { .. } => w.capsule,
        ToolShape::Box { .. } => w.block,
        ToolShape::Torus { .. } => w.torus,
        ToolShape::Curve { .. } => w.curve,
        ToolShape::Mesh { .. } => w.mesh,
        ToolShape::Clay { .. } => w.baked,
    }
}

#[cfg(test)]
mod tests {
    use super::super::set_lang;
    use super::*;
    use crate::document::{Document, Edit};
    use crate::math::Placement;

    #[test]
    fn a_plate_is_no_scan() {
        let title = |lang, json: &str| {
            set_lang(lang);
            let document = Document::from_json(json).expect("a valid document");
            subject_title(document.illustration())
        };
        let file = format!(
            r#"{{"fabrica":1,"subject":{{"sha256":"{}"}}"#,
            "a".repeat(64)
        );
        let (scan, plate) = (format!("{file}}}"), format!(r#"{file},"figure":{{}}}}"#));
        for (lang, of_scan, of_plate) in [
            (Lang::English, "Your scan", "Your plate"),
            (Lang::German, "Eigener Scan", "Eigene Bildtafel"),
            (Lang::Spanish, "Estudio propio", "Lámina propia"),
            (Lang::Chinese, "自己的扫描", "自己的图版"),
        ] {
            assert_eq!(title(lang, &scan), of_scan);
            assert_eq!(title(lang, &plate), of_plate);
        }
        let address = r#"{"fabrica":1,"subject":{"src":"a.png"},"figure":{}}"#;
        assert_eq!(title(Lang::English, address), "Plate from an address");
        let named = r#"{"fabrica":1,"subject":{"src":"a.png","name":"Elbow"},"figure":{}}"#;
        assert_eq!(title(Lang::English, named), "Elbow");
    }

    #[test]
    fn steps_of_undo_are_named_in_the_language() {
        set_lang(Lang::German);
        let document = Document::new();
        let placement = Placement {
            at: glam::Vec3::ZERO,
            rotate: glam::Quat::IDENTITY,
            size: glam::Vec3::ONE,
        };
        let add = Edit::AddTemplate {
            index: 0,
            kind: TemplateKind::Peel,
            placement,
        };
        assert_eq!(edit_title(&add.name(&document)), "Abrollen hinzufügen");
        let document = add.apply(&document).expect("an empty document takes it");
        let value = crate::document::ParamValue::Number(0.2);
        let edit = Edit::SetParam {
            template: 0,
            param: "depth",
            value,
        };
        assert_eq!(
            edit_title(&edit.name(&document)),
            "Tiefe von Abrollen ändern"
        );
        assert_eq!(
            edit_title(&Edit::SetTitle(String::new()).name(&document)),
            "Titel ändern"
        );
        assert_eq!(edit_title("Set peculiar"), "Set peculiar");
        set_lang(Lang::English);
    }

    #[test]
    fn what_is_built_in_has_words() {
        set_lang(Lang::Chinese);
        for name in crate::subjects::names() {
            assert!(!subject(name).is_ascii(), "{name}");
        }
        for tool in crate::document::SceneObject::BUILTINS {
            let name = super::super::objects::tool(tool);
            assert!(!name.is_ascii(), "{tool}");
            assert_ne!(name, super::super::objects::tool("unknown"), "{tool}");
        }
        for one in crate::document::presets() {
            assert!(
                one.name == "mri" || preset(one.name, one.title) != one.title,
                "{}",
                one.name
            );
        }
        for one in crate::document::STYLE_PRESETS {
            let name = style_preset(one.name, one.title);
            assert_ne!(name, one.title, "{}", one.name);
        }
        set_lang(Lang::English);
    }
}
