//! What readers make of a file, before anything is repaired: corners and faces as the file has them.

use glam::{Vec2, Vec3};

use super::error::MeshError;
use super::options::Axes;
use super::report::Aside;
use super::textures::texture;
use crate::data::{Coloring, MeshMaterial, MeshTexture, NO_INDEX, Wrap};
use crate::pictures::{MAX_FILE_BYTES, PictureError};

/// Textures of a file at most: each may take a second to unpack.
const MAX_TEXTURES: usize = 256;

/// A corner of a face: indices into the lists of the draft, or [`NO_INDEX`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Corner {
    pub(super) position: u32,
    pub(super) uv: u32,
    pub(super) normal: u32,
}

/// A face: the corners from the end of the face before it to `end`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    pub(super) end: u32,
    /// Index into [`Draft::parts`].
    pub(super) part: u32,
    /// Index into [`Draft::materials`], or [`NO_INDEX`].
    pub(super) material: u32,
}

/// A mesh as a file has it, in the file's units and axes.
pub(super) struct Draft {
    name: String,
    limit: u64,
    /// Triangles that the faces come to.
    triangle_count: u64,
    pub(super) positions: Vec<Vec3>,
    /// Linear light, one for each position; empty if there is none.
    pub(super) colors: Vec<Option<Vec3>>,
    pub(super) coloring: Coloring,
    pub(super) normals: Vec<Vec3>,
    /// v down.
    pub(super) uvs: Vec<Vec2>,
    pub(super) corners: Vec<Corner>,
    pub(super) faces: Vec<Face>,
    /// What the file calls its parts; empty names where it says nothing.
    pub(super) parts: Vec<String>,
    pub(super) materials: Vec<MeshMaterial>,
    pub(super) textures: Vec<MeshTexture>,
    /// The axes that the file itself names.
    pub(super) space: Option<Axes>,
    /// Points and lines that were found.
    pub(super) point_count: u64,
    pub(super) line_count: u64,
    /// Faces of fewer than three corners.
    pub(super) short_faces: u64,
    /// What was left aside.
    pub(super) aside: Vec<Aside>,
}

impl Draft {
    pub(super) fn new(name: &str, limit: u64) -> Self {
        Self {
            name: name.to_owned(),
            // Indices of corners are 32 bits.
            limit: limit.min(1 << 28),
            triangle_count: 0,
            positions: Vec::new(),
            colors: Vec::new(),
            coloring: Coloring::First,
            normals: Vec::new(),
            uvs: Vec::new(),
            corners: Vec::new(),
            faces: Vec::new(),
            parts: Vec::new(),
            materials: Vec::new(),
            textures: Vec::new(),
            space: None,
            point_count: 0,
            line_count: 0,
            short_faces: 0,
            aside: Vec::new(),
        }
    }

    /// Counts what is left aside, once each.
    pub(super) fn leave(&mut self, what: Aside) {
        if !self.aside.contains(&what) {
            self.aside.push(what);
        }
    }

    /// That a list may grow by one.
    fn has_room(&self, what: &'static str, count: usize) -> Result<(), MeshError> {
        if (count as u64) < self.most_values() {
            return Ok(());
        }
        Err(MeshError::TooManyValues {
            name: self.name.clone(),
            what,
            count: count as u64 + 1,
            limit: self.limit,
        })
    }

    /// Adds a position; its index.
    ///
    /// # Errors
    /// [`MeshError::TooManyValues`], as of the other lists.
    pub(super) fn add_position(&mut self, position: Vec3) -> Result<u32, MeshError> {
        self.has_room("vertices", self.positions.len())?;
        self.positions.push(position);
        Ok(self.positions.len() as u32 - 1)
    }

    /// Gives the last position a colour, linear light. One that is not finite counts as missing.
    pub(super) fn color_last(&mut self, color: Vec3) {
        let before = self.positions.len() - 1;
        self.colors.resize(before, None);
        self.colors.push(color.is_finite().then_some(color));
    }

    pub(super) fn add_normal(&mut self, normal: Vec3) -> Result<u32, MeshError> {
        self.has_room("normals", self.normals.len())?;
        self.normals.push(normal);
        Ok(self.normals.len() as u32 - 1)
    }

    pub(super) fn add_uv(&mut self, uv: Vec2) -> Result<u32, MeshError> {
        self.has_room("texture coordinates", self.uvs.len())?;
        self.uvs.push(uv);
        Ok(self.uvs.len() as u32 - 1)
    }

    /// That packed pictures may grow by so many bytes: of all of them together as many may come as of one.
    ///
    /// # Errors
    /// That the picture is left aside.
    pub(super) fn has_room_for_picture(&self, bytes: u64) -> Result<(), Aside> {
        let held = self
            .textures
            .iter()
            .map(|texture| texture.packed.len() as u64);
        let bytes = held.sum::<u64>().saturating_add(bytes);
        match bytes <= MAX_FILE_BYTES {
            true => Ok(()),
            false => Err(Aside::Picture(PictureError::LargeFile { bytes })),
        }
    }

    /// Adds a texture from the bytes of a picture; its index. One that is none, or one too many, is left aside.
    pub(super) fn add_texture(&mut self, packed: Vec<u8>, wrap: [Wrap; 2]) -> Option<u32> {
        if self.textures.len() == MAX_TEXTURES {
            self.leave(Aside::ManyTextures);
            return None;
        }
        match texture(packed, wrap) {
            Ok(texture) => {
                self.textures.push(texture);
                Some(self.textures.len() as u32 - 1)
            }
            Err(error) => {
                self.leave(Aside::Picture(error));
                None
            }
        }
    }

    /// Adds a part; its index.
    pub(super) fn add_part(&mut self, name: &str) -> u32 {
        self.parts.push(crate::load::report::clean_name(name));
        self.parts.len() as u32 - 1
    }

    /// That this many triangles may come.
    ///
    /// # Errors
    /// [`MeshError::TooManyTriangles`].
    pub(super) fn has_room_for(&self, triangles: u64) -> Result<(), MeshError> {
        let count = self.triangle_count.saturating_add(triangles);
        if count <= self.limit {
            return Ok(());
        }
        Err(MeshError::TooManyTriangles {
            name: self.name.clone(),
            count,
            limit: self.limit,
        })
    }

    /// Values that a list may have: as many as the triangles that may be opened have corners.
    pub(super) fn most_values(&self) -> u64 {
        3 * self.limit
    }

    /// Adds a face. One of fewer than three corners is counted only.
    ///
    /// # Errors
    /// [`MeshError::TooManyTriangles`], before the list grows.
    pub(super) fn add_face(
        &mut self,
        corners: &[Corner],
        part: u32,
        material: u32,
    ) -> Result<bool, MeshError> {
        if corners.len() < 3 {
            self.short_faces += 1;
            return Ok(false);
        }
        self.has_room_for(corners.len() as u64 - 2)?;
        self.triangle_count += corners.len() as u64 - 2;
        self.corners.extend_from_slice(corners);
        self.faces.push(Face {
            end: self.corners.len() as u32,
            part,
            material,
        });
        Ok(true)
    }

    /// Adds a triangle whose corners have all their values at one index, as in formats with one list of vertices.
    pub(super) fn add_triangle(
        &mut self,
        vertices: [u32; 3],
        part: u32,
        material: u32,
    ) -> Result<(), MeshError> {
        let corners = vertices.map(|index| self.corner(index));
        self.add_face(&corners, part, material)?;
        Ok(())
    }

    /// The corner at a vertex of a format with one list of vertices. Normals and texture coordinates are there if
    /// their lists reach so far.
    pub(super) fn corner(&self, index: u32) -> Corner {
        let within = |len: usize| {
            if (index as usize) < len {
                index
            } else {
                NO_INDEX
            }
        };
        Corner {
            position: index,
            uv: within(self.uvs.len()),
            normal: within(self.normals.len()),
        }
    }

    /// Keeps the first faces only.
    pub(super) fn keep_triangles(&mut self, count: usize) {
        self.faces.truncate(count);
        self.corners.truncate(3 * count);
        self.positions.truncate(3 * count);
        self.triangle_count = count as u64;
    }

    /// Each face with its corners.
    pub(super) fn faces(&self) -> impl Iterator<Item = (&Face, &[Corner])> {
        let mut start = 0;
        self.faces.iter().map(move |face| {
            let end = face.end as usize;
            let corners = &self.corners[start..end];
            start = end;
            (face, corners)
        })
    }

    /// What there is instead of triangles, for a message.
    pub(super) fn found(&self) -> String {
        let face_count = self.faces.len() as u64 + self.short_faces;
        let is_points = face_count + self.point_count + self.line_count == 0;
        let vertices = if is_points { "points" } else { "vertices" };
        let counts = [
            (self.positions.len() as u64, vertices),
            (self.point_count, "points"),
            (self.line_count, "lines"),
        ];
        let found = counts.iter().filter(|(count, _)| *count > 0);
        let mut parts: Vec<String> = found.map(|(n, what)| format!("{n} {what}")).collect();
        parts.push(match face_count {
            0 => "no faces".to_owned(),
            n => format!("{n} faces, none of them usable"),
        });
        parts.join(", ")
    }
}
