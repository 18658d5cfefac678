//! From a document to what the shaders read: uniforms, the transfer table, the camera. Nothing here needs a GPU.

pub(crate) mod bodies;
pub(crate) mod filling;
pub(crate) mod frame;
pub mod gpu_types;
pub(crate) mod kept;
pub(crate) mod laid;
pub(crate) mod look;
pub(crate) mod marks;
pub(crate) mod mesh_look;
pub(crate) mod notice;
pub(crate) mod objects;
pub(crate) mod raycast_key;
pub(crate) mod stamps;
pub(crate) mod style;
pub(crate) mod triangles;
pub(crate) mod values;
pub(crate) mod view;
