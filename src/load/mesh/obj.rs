//! Wavefront OBJ.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3};

use super::draft::{Corner, Draft};
use super::error::MeshError;
use super::input::{Input, Lines, shown, space_in};
use super::mtl::linear;
use super::report::Aside;
use crate::data::mesh::polygon::MAX_CORNERS;
use crate::data::{MeshMaterial, NO_INDEX};

/// Material libraries that are looked for, and materials.
const MAX_LIBRARIES: usize = 64;
const MAX_MATERIALS: usize = 65_536;

/// The part of faces before any object or group: the first.
const UNNAMED: u32 = 0;

/// What stands in other files.
#[derive(Default)]
pub(super) struct Elsewhere {
    /// Paths of material libraries, as written.
    pub(super) libraries: Vec<String>,
    /// Names of materials with their index.
    pub(super) materials: BTreeMap<String, u32>,
}

/// From which face on which object and group are meant.
struct Run {
    first_face: usize,
    object: Option<u32>,
    group: Option<u32>,
}

struct Reader<'d> {
    draft: &'d mut Draft,
    /// Objects and groups by their names; the index is that of the part.
    objects: BTreeMap<String, u32>,
    groups: BTreeMap<String, u32>,
    runs: Vec<Run>,
    material: u32,
    elsewhere: Elsewhere,
    /// The line of each face, for indices that are found out of range when all vertices are there.
    lines: Vec<u32>,
}

/// Reads an OBJ; what it looks for in other files is for the caller to read.
pub(super) fn read(input: &mut Input<'_, '_>, draft: &mut Draft) -> Result<Elsewhere, MeshError> {
    let mut reader = Reader {
        draft,
        objects: BTreeMap::new(),
        groups: BTreeMap::new(),
        runs: Vec::new(),
        material: NO_INDEX,
        elsewhere: Elsewhere::default(),
        lines: Vec::new(),
    };
    reader.draft.add_part("");
    let mut lines = Lines::new(input, 0);
    let mut corners = Vec::new();
    while lines.advance(true)? {
        reader.read_line(&lines, &mut corners)?;
    }
    reader.check(&lines)?;
    reader.name_parts();
    Ok(reader.elsewhere)
}

impl Reader<'_> {
    fn read_line(
        &mut self,
        lines: &Lines<'_, '_, '_>,
        corners: &mut Vec<Corner>,
    ) -> Result<(), MeshError> {
        let text = lines.text();
        let text = text.trim_start();
        if text.starts_with('#') {
            self.draft.space = self.draft.space.or(space_in(text));
            return Ok(());
        }
        // A remark may stand behind a statement; names may hold the sign.
        let (keyword, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
        let mut words = rest
            .split_whitespace()
            .take_while(|word| !word.starts_with('#'));
        let number = |word: Option<&str>| -> Result<f32, MeshError> {
            let Some(word) = word else {
                return Err(lines.wrong("expected a number, found the end of the line"));
            };
            word.parse()
                .map_err(|_not_a_number: std::num::ParseFloatError| {
                    lines.wrong(format!("expected a number, found “{}”", shown(word)))
                })
        };
        match keyword {
            "v" => {
                let position = [
                    number(words.next())?,
                    number(words.next())?,
                    number(words.next())?,
                ];
                self.draft.add_position(Vec3::from_array(position))?;
                let more: Vec<&str> = words.take(4).collect();
                // A single number is a weight, which polygons have no use for; behind it colours may stand.
                let color = match more[..] {
                    [r, g, b] | [_, r, g, b, ..] => [r, g, b],
                    _ => return Ok(()),
                };
                let [r, g, b] = color;
                let color = [number(Some(r))?, number(Some(g))?, number(Some(b))?];
                let is_finite = color.iter().all(|x| x.is_finite());
                self.draft
                    .color_last(if is_finite { linear(color) } else { Vec3::NAN });
            }
            "vt" => {
                let u = number(words.next())?;
                let v = words.next().map_or(Ok(0.0), |word| number(Some(word)))?;
                self.draft.add_uv(Vec2::new(u, 1.0 - v))?;
            }
            "vn" => {
                let normal = [
                    number(words.next())?,
                    number(words.next())?,
                    number(words.next())?,
                ];
                self.draft.add_normal(Vec3::from_array(normal))?;
            }
            "f" | "fo" => {
                corners.clear();
                for word in words {
                    if corners.len() == MAX_CORNERS {
                        return Err(
                            lines.wrong(format!("a face of more than {MAX_CORNERS} corners"))
                        );
                    }
                    corners.push(self.corner(word, lines)?);
                }
                if self.draft.add_face(corners, 0, self.material)? {
                    self.lines
                        .push(u32::try_from(lines.number()).unwrap_or(u32::MAX));
                }
            }
            "o" => {
                let part = self.part(rest.trim(), true);
                self.run().object = Some(part);
            }
            "g" => {
                let part = self.part(rest.trim(), false);
                self.run().group = Some(part);
            }
            "usemtl" => self.material = self.material(rest.trim()),
            "mtllib" if self.elsewhere.libraries.len() < MAX_LIBRARIES => {
                let path = rest.trim().to_owned();
                if !path.is_empty() && !self.elsewhere.libraries.contains(&path) {
                    self.elsewhere.libraries.push(path);
                }
            }
            "p" => {
                self.draft.point_count += 1;
                self.draft.leave(Aside::Points);
            }
            "l" => {
                self.draft.line_count += 1;
                self.draft.leave(Aside::Lines);
            }
            "curv" | "curv2" | "surf" => self.draft.leave(Aside::Curves),
            // Smoothing groups, parameters of curves and whatever a program adds: nothing that is drawn.
            _ => {}
        }
        Ok(())
    }

    /// A corner as `v`, `v/vt`, `v//vn` or `v/vt/vn`, each part but the first possibly empty.
    fn corner(&self, word: &str, lines: &Lines<'_, '_, '_>) -> Result<Corner, MeshError> {
        let mut parts = word.split('/');
        let mut index = |count: usize, what: &str, is_needed: bool| -> Result<u32, MeshError> {
            let part = parts.next().unwrap_or_default();
            if part.is_empty() && !is_needed {
                return Ok(NO_INDEX);
            }
            let Ok(number) = part.parse::<i64>() else {
                let found = shown(word);
                return Err(
                    lines.wrong(format!("expected the number of a {what}, found “{found}”"))
                );
            };
            let from_start = match number {
                1.. => Some(number - 1),
                0 => None,
                // Counted back from those that are there by now.
                _ => (count as i64)
                    .checked_add(number)
                    .filter(|index| *index >= 0),
            };
            let from_start = from_start.and_then(|index| u32::try_from(index).ok());
            from_start
                .filter(|index| *index != NO_INDEX)
                .ok_or_else(|| {
                    lines.wrong(format!(
                        "{what} {number} is out of range: there are {count}"
                    ))
                })
        };
        let corner = Corner {
            position: index(self.draft.positions.len(), "vertex", true)?,
            uv: index(self.draft.uvs.len(), "texture coordinate", false)?,
            normal: index(self.draft.normals.len(), "normal", false)?,
        };
        match parts.next() {
            None => Ok(corner),
            Some(_) => Err(lines.wrong(format!("expected a corner, found “{}”", shown(word)))),
        }
    }

    /// What is out of range at a face.
    fn check_face(&self, corners: &[Corner]) -> Result<(), String> {
        for corner in corners {
            let checks = [
                (corner.position, self.draft.positions.len(), "vertex"),
                (corner.uv, self.draft.uvs.len(), "texture coordinate"),
                (corner.normal, self.draft.normals.len(), "normal"),
            ];
            for (index, count, what) in checks {
                if index != NO_INDEX && index as usize >= count {
                    return Err(format!(
                        "{what} {} is out of range: there are {count}",
                        u64::from(index) + 1
                    ));
                }
            }
        }
        Ok(())
    }

    /// Checks the indices of all faces. Vertices may stand behind the faces that use them.
    fn check(&self, lines: &Lines<'_, '_, '_>) -> Result<(), MeshError> {
        for ((_, corners), &line) in self.draft.faces().zip(&self.lines) {
            let checked = self.check_face(corners);
            checked.map_err(|what| lines.wrong_at(u64::from(line), what))?;
        }
        Ok(())
    }

    /// The part of an object or a group of this name.
    fn part(&mut self, name: &str, is_object: bool) -> u32 {
        let names = if is_object {
            &mut self.objects
        } else {
            &mut self.groups
        };
        if let Some(&part) = names.get(name) {
            return part;
        }
        let part = self.draft.add_part(name);
        names.insert(name.to_owned(), part);
        part
    }

    /// The run that begins at the next face.
    fn run(&mut self) -> &mut Run {
        let first_face = self.draft.faces.len();
        let (object, group) = self
            .runs
            .last()
            .map_or((None, None), |run| (run.object, run.group));
        if self
            .runs
            .last()
            .is_some_and(|run| run.first_face == first_face)
        {
            self.runs.pop();
        }
        self.runs.push(Run {
            first_face,
            object,
            group,
        });
        let last = self.runs.len() - 1;
        &mut self.runs[last]
    }

    fn material(&mut self, name: &str) -> u32 {
        if let Some(&index) = self.elsewhere.materials.get(name) {
            return index;
        }
        if self.draft.materials.len() == MAX_MATERIALS {
            self.draft.leave(Aside::ManyMaterials);
            return NO_INDEX;
        }
        // White and opaque until a library says more.
        self.draft.materials.push(MeshMaterial {
            color: Vec3::ONE,
            has_color: false,
            opacity: 1.0,
            texture: None,
        });
        let index = self.draft.materials.len() as u32 - 1;
        self.elsewhere.materials.insert(name.to_owned(), index);
        index
    }

    /// Gives every face its part: that of its object if the file names objects at all, else that of its group.
    fn name_parts(&mut self) {
        let has_objects = !self.objects.is_empty();
        let mut runs = self.runs.iter().peekable();
        let mut part = UNNAMED;
        for (i, face) in self.draft.faces.iter_mut().enumerate() {
            while let Some(run) = runs.next_if(|run| run.first_face <= i) {
                part = if has_objects { run.object } else { run.group }.unwrap_or(UNNAMED);
            }
            face.part = part;
        }
    }
}
