//! The description of a GLB in JSON, looked at with care: any of it may be missing or of another kind.

use serde_json::Value;

use super::error::MeshError;

/// The description of a GLB, and its block of bytes.
pub(super) struct Gltf {
    pub(super) name: String,
    pub(super) json: Value,
    pub(super) bytes: Vec<u8>,
    /// Elements that an accessor may have.
    pub(super) most_elements: u64,
}

impl Gltf {
    pub(super) fn wrong(&self, what: String) -> MeshError {
        MeshError::Content {
            name: self.name.clone(),
            what,
        }
    }

    /// The elements of a list of the description; none if there is no such list.
    pub(super) fn list(&self, key: &str) -> &[Value] {
        self.json
            .get(key)
            .and_then(Value::as_array)
            .map_or(&[], Vec::as_slice)
    }

    /// An element of such a list.
    ///
    /// # Errors
    /// [`MeshError::Content`] if it has no such element.
    pub(super) fn item(&self, key: &str, index: usize) -> Result<&Value, MeshError> {
        let list = self.list(key);
        list.get(index).ok_or_else(|| {
            self.wrong(format!(
                "{key} {index} is out of range: there are {}",
                list.len()
            ))
        })
    }
}

/// An index or count in the description; `None` if there is none.
pub(super) fn index(value: &Value, key: &str) -> Option<usize> {
    value
        .get(key)
        .and_then(Value::as_u64)
        .and_then(|n| usize::try_from(n).ok())
}

/// Numbers of a list of known length; `None` if they are not all there.
pub(super) fn numbers<const N: usize>(value: &Value, key: &str) -> Option<[f64; N]> {
    let list = value.get(key)?.as_array()?;
    let all: Option<Vec<f64>> = list.iter().map(Value::as_f64).collect();
    all?.try_into().ok()
}
