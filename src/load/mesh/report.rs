//! What reading a mesh found out beside the triangles.

use std::fmt;

use super::format::MeshFormat;
use super::options::{Axes, Units};
use crate::math::hex;
use crate::pictures::PictureError;

/// What a file holds that is not drawn. Named once each, never with words of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Aside {
    /// Points, which have no surface.
    Points,
    /// Lines, which have no surface.
    Lines,
    /// Curves and free-form surfaces.
    Curves,
    /// A material library that is not there or cannot be read.
    NoLibrary,
    /// A picture that is not there.
    NoPicture,
    /// A picture that cannot be read.
    Picture(PictureError),
    /// More textures than are kept.
    ManyTextures,
    /// A picture of inks, whose colours were taken by inversion.
    Inks,
    /// A picture that was made smaller, so that all of them fit.
    Reduced {
        /// Width and height in the file, pixels.
        from: [u32; 2],
        /// Width and height that are drawn.
        to: [u32; 2],
    },
    /// Colours in the attribute of an STL's triangles.
    Attributes,
    /// The count of triangles in an STL's header is wrong.
    WrongCount,
    /// Properties of faces other than their corners, such as colours.
    FaceProperties,
    /// A texture that is only named.
    NamedTexture,
    /// Skins and morph targets: the stored shape is taken.
    Skins,
    /// Animations: the shape is shown as it is stored.
    Animations,
    /// Textures that are no base colour, or not on the first texture coordinates.
    OtherTextures,
    /// Bytes after the end.
    TrailingBytes,
    /// More materials than are kept.
    ManyMaterials,
}

impl Aside {
    /// True for what only has to do with colours and textures: a reader who wants none need not hear of it.
    pub fn is_of_colors(&self) -> bool {
        match self {
            Self::NoLibrary
            | Self::NoPicture
            | Self::Picture(_)
            | Self::ManyTextures
            | Self::Inks
            | Self::Reduced { .. }
            | Self::Attributes
            | Self::NamedTexture
            | Self::OtherTextures
            | Self::ManyMaterials => true,
            Self::Points
            | Self::Lines
            | Self::Curves
            | Self::WrongCount
            | Self::FaceProperties
            | Self::Skins
            | Self::Animations
            | Self::TrailingBytes => false,
        }
    }
}

impl fmt::Display for Aside {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Points => "points are left aside",
            Self::Lines => "lines are left aside",
            Self::Curves => "curves and free-form surfaces are left aside",
            Self::NoLibrary => {
                "a material library is not there or cannot be read; it is left aside"
            }
            Self::NoPicture => "a texture's picture is not there; it is left aside",
            Self::Picture(error) => return write!(f, "a texture is left aside: {error}"),
            Self::ManyTextures => {
                "there are more textures than are kept; the others are left aside"
            }
            Self::Inks => "a texture mixes inks (CMYK); its colours were taken by inversion",
            Self::Reduced { from, to } => {
                let ([w, h], [to_w, to_h]) = (from, to);
                return write!(
                    f,
                    "a texture of {w} × {h} pixels was reduced to {to_w} × {to_h}"
                );
            }
            Self::Attributes => "colours in the attributes of triangles are left aside",
            Self::WrongCount => {
                "the header's count of triangles is wrong; those that are there were taken"
            }
            Self::FaceProperties => "properties of faces are left aside",
            Self::NamedTexture => "a texture that is only named is left aside",
            Self::Skins => "skins and morph targets are left aside: the stored shape is shown",
            Self::Animations => "animations are left aside",
            Self::OtherTextures => "other textures than the base colour's are left aside",
            Self::TrailingBytes => "there are bytes after the end; they were left out",
            Self::ManyMaterials => {
                "there are more materials than are kept; the others are left aside"
            }
        })
    }
}

/// How often something was repaired.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Repair {
    /// Corners that repeat their neighbour, dropped from polygons.
    pub repeated_corners: u64,
    /// Faces with fewer than three corners left, left out.
    pub short_faces: u64,
    /// Faces with a vertex that is not finite, left out.
    pub not_finite_faces: u64,
    /// Triangles with two equal corners, dropped.
    pub degenerate: u64,
    /// Triangles that were there before, with the same turn, dropped.
    pub duplicate: u64,
    /// Normals at corners that are not finite, zero, or more than 90° off their triangle.
    pub bad_normals: u64,
    /// Edges of two triangles across which they disagreed about the front.
    pub disagreeing_edges: u64,
    /// Triangles that were turned over.
    pub turned: u64,
    /// Edges across which triangles still disagree, since no turning helps (Möbius strips).
    pub one_sided_edges: u64,
}

impl Repair {
    /// What was done, as phrases; empty if nothing was.
    pub fn phrases(&self) -> Vec<String> {
        let counts = [
            (self.repeated_corners, "repeated corners dropped"),
            (
                self.short_faces,
                "faces of fewer than three corners left out",
            ),
            (
                self.not_finite_faces,
                "faces with a vertex that is no number left out",
            ),
            (self.degenerate, "triangles with two equal corners dropped"),
            (self.duplicate, "doubled triangles dropped"),
            (self.bad_normals, "normals replaced"),
            (
                self.disagreeing_edges,
                "edges across which triangles disagreed",
            ),
            (self.turned, "triangles turned over"),
            (
                self.one_sided_edges,
                "edges across which they disagree still (one-sided)",
            ),
        ];
        let done = counts.iter().filter(|(count, _)| *count > 0);
        done.map(|(count, what)| format!("{count} {what}"))
            .collect()
    }
}

/// Who said in which units or axes a file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The document, or whoever asked.
    Given,
    /// A comment or header of the file.
    File,
    /// Nobody: the format's default.
    Format,
}

/// What reading a mesh found out beside the triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshReport {
    /// The format of the file.
    pub format: MeshFormat,
    /// Its form, as “binary” or “ASCII”; empty where there is one only.
    pub form: &'static str,
    /// One unit of the file, and who said so.
    pub units: (Units, Origin),
    /// Directions of its axes, and who said so.
    pub axes: (Axes, Origin),
    /// What was repaired.
    pub repair: Repair,
    /// What was left aside.
    pub aside: Vec<Aside>,
    /// SHA-256 over the bytes of the file as they lie on disk.
    pub sha256: [u8; 32],
}

impl MeshReport {
    /// The hash as documents write it.
    pub fn sha256_hex(&self) -> String {
        hex(&self.sha256)
    }

    /// What the user should know, a line each: what was left aside, then what was repaired.
    pub fn notices(&self) -> Vec<String> {
        let mut lines: Vec<String> = self.aside.iter().map(ToString::to_string).collect();
        let repaired = self.repair.phrases();
        if !repaired.is_empty() {
            lines.push(format!("the mesh was repaired: {}", repaired.join("; ")));
        }
        lines
    }
}
