//! What the bodies of meshes are made of: edits of their layers.

use serde_json::{Map, Value, json};

use super::session::Session;
use crate::document::{Edit, Layer, color_text, plain_f64};

/// Where the list stands in the document.
const LAYERS: &str = "/look/layers";

impl Session {
    /// True if a mesh is shown, alone or beside a scan: then there are bodies.
    pub fn has_meshes(&self) -> bool {
        !self.view.has_values() || !self.shown().meshes().is_empty()
    }

    /// The edit that changes the list of layers, given as entries of the document in its order. A built-in subject's
    /// own layers become the document's by it.
    pub fn layers_edit(
        &self,
        name: &str,
        change: impl FnOnce(&mut Vec<Map<String, Value>>),
    ) -> Edit {
        let mut layers = self.layers_in_document();
        change(&mut layers);
        Edit::Set {
            pointer: LAYERS.to_owned(),
            value: json!(layers),
            name: name.to_owned(),
        }
    }

    /// The list as it stands in the document at the step that is shown, unknown keys included; without one the layers
    /// that are drawn.
    fn layers_in_document(&self) -> Vec<Map<String, Value>> {
        let state = self.document().at_step(self.step()).ok();
        let written = state
            .as_ref()
            .and_then(|state| state.get(LAYERS)?.as_array());
        match written {
            Some(list) => {
                let entries = list.iter().map(|layer| layer.as_object().cloned());
                entries.map(Option::unwrap_or_default).collect()
            }
            None => self
                .shown()
                .look
                .surface
                .layers
                .iter()
                .map(written_out)
                .collect(),
        }
    }
}

/// A layer as an entry of the document.
fn written_out(layer: &Layer) -> Map<String, Value> {
    let mut entry = Map::new();
    entry.insert("depth".to_owned(), json!(plain_f64(layer.depth)));
    entry.insert("name".to_owned(), json!(layer.name));
    if let Some(color) = layer.color_srgb {
        entry.insert("color".to_owned(), json!(color_text(color)));
    }
    entry.insert("grain".to_owned(), json!(plain_f64(layer.grain)));
    entry
}
