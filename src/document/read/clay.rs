//! Reading of a clay: what it is made from, its tools and its strokes.

use super::object::{Object, number, wrong};
use super::reader::Reader;
use crate::document::limits::{BUILTIN_SUBJECTS, DEFAULT_SUBJECT, MAX_BYTES, MESH_SUBJECTS};
use crate::document::model::{
    Clay, ClayKey, ClayMove, ClayShape, ClayStart, ClayStroke, ClayTool, ClayVolume, MeshRef,
    Reading, VoxelPart, VoxelSource, is_drawn_name,
};
use crate::document::schema::{CLAY, Kind};
use crate::document::text::pointer::join;
use crate::document::text::{DocumentError, NoticeKind, json, shortened};
use glam::DVec3;
use serde_json::Value;

/// Size of a tool that nothing is said of, per cent.
const WHOLE_SIZE: i32 = 100;

/// The recipe of a text that [`clay_to_text`] wrote.
///
/// # Errors
/// The first fault, named by its pointer in a document (`/subject/clay/detail`).
///
/// [`clay_to_text`]: crate::document::clay_to_text
pub fn clay_from_text(text: &str) -> Result<Clay, DocumentError> {
    if text.len() > MAX_BYTES {
        return Err(DocumentError::TooLarge {
            found: text.len(),
            limit: MAX_BYTES,
        });
    }
    let value = json::read(text)?;
    let object = Object::new("/subject/clay".to_owned(), &value, CLAY)?;
    Reader::default().clay(&object)
}

impl Reader {
    pub(super) fn clay(&mut self, object: &Object<'_>) -> Result<Clay, DocumentError> {
        self.unknown_keys(object);
        let from = self.clay_start(&object.child("from")?)?;
        let detail = self.exact(object, "detail")?;
        let mut tools = Vec::new();
        for tool in object.children("tools")? {
            tools.push(self.clay_tool(&tool?)?);
        }
        if !object.map.contains_key("tools") {
            tools.push(ClayTool::default());
        }
        let mut strokes = Vec::new();
        for (index, stroke) in object.children("strokes")?.enumerate() {
            let stroke = stroke?;
            let read = self.clay_stroke(&stroke, tools.len())?;
            self.note_made_of_itself(&stroke, index, &read, &tools);
            strokes.push(read);
        }
        Ok(Clay {
            from,
            detail,
            tools,
            strokes,
        })
    }

    fn clay_start(&mut self, from: &Object<'_>) -> Result<ClayStart, DocumentError> {
        let mesh = MeshRef {
            index: 0,
            src: from.text("src")?.map(str::to_owned),
            sha256: from.hash()?,
            name: from.string("name")?,
            reading: self.reading_as_whole(from)?,
        };
        let shape = from.text("shape")?;
        self.unknown_keys(from);
        let volume = self.clay_volume(from)?;
        if from.map.contains_key("of") {
            let others = ["shape", "src", "sha256", "name", "units", "axes"];
            self.left_aside(from, &others, "a clay of a volume");
            let Some(volume) = volume else {
                let what = "a clay of a volume of which neither a segment nor a value is named is";
                self.note(from.at("of"), NoticeKind::NotDrawn { what });
                return Ok(ClayStart::Unknown("of".to_owned()));
            };
            return Ok(ClayStart::Volume(Box::new(volume)));
        }
        let others = ["segment", "iso", "walls"];
        self.left_aside(from, &others, "a clay of no volume");
        if mesh.src.is_some() || mesh.sha256.is_some() {
            if shape.is_some() {
                let taken = "the clay of a file";
                self.note(from.at("shape"), NoticeKind::LeftAside { taken });
            }
            return Ok(ClayStart::Mesh(mesh));
        }
        let known = self.choice_if_any(from, "shape", "nothing")?;
        Ok(match (known, shape) {
            (None, Some(name)) => ClayStart::Unknown(name.to_owned()),
            (index, _) => ClayStart::Shape(ClayShape::ALL[index.unwrap_or(0)]),
        })
    }

    /// The part of a volume that is meant; `None` where none is named.
    fn clay_volume(&mut self, from: &Object<'_>) -> Result<Option<ClayVolume>, DocumentError> {
        let of = self.voxel_source(&from.child("of")?)?;
        let segment = from.text("segment")?.filter(|name| !name.is_empty());
        let iso = from
            .map
            .contains_key("iso")
            .then(|| self.exact(from, "iso"));
        let iso = iso.transpose()?;
        let has_all_walls = self.choice(from, "walls")? == 1;
        let part = match (segment, iso) {
            (Some(name), iso) => {
                if iso.is_some() {
                    self.left_aside(from, &["iso"], "the segment");
                }
                VoxelPart::Segment(name.to_owned())
            }
            (None, Some(value)) => VoxelPart::Iso(value),
            (None, None) => return Ok(None),
        };
        Ok(Some(ClayVolume {
            of,
            part,
            has_all_walls,
        }))
    }

    /// Where voxels come from. What has none is refused: a clay, meshes, figures.
    fn voxel_source(&mut self, of: &Object<'_>) -> Result<VoxelSource, DocumentError> {
        const VOXELS: &str = "a built-in subject made of voxels, or a scan";
        for key in ["clay", "meshes"] {
            if let Some(found) = of.map.get(key) {
                return Err(wrong(&of.at(key), VOXELS, found));
            }
        }
        self.unknown_keys(of);
        let builtin = of.text("builtin")?;
        if let Some((name, found)) = builtin.zip(of.map.get("builtin")) {
            if MESH_SUBJECTS.contains(&name) || is_drawn_name(name) {
                return Err(wrong(&of.at("builtin"), VOXELS, found));
            }
            if !BUILTIN_SUBJECTS.contains(&name) {
                let found = shortened(name, 40);
                self.note(of.at("builtin"), NoticeKind::UnknownSubject { found });
            }
        }
        let raw = of.map.contains_key("raw").then(|| of.child("raw"));
        let raw = raw.transpose()?.map(|raw| self.raw(&raw)).transpose()?;
        let file = VoxelSource::File {
            src: of.text("src")?.map(str::to_owned),
            sha256: of.hash()?,
            name: of.string("name")?,
            reading: Reading {
                frame: of.whole("frame")?,
                raw,
                ..Reading::default()
            },
        };
        let has_file = ["src", "sha256"]
            .iter()
            .any(|key| of.map.contains_key(*key));
        if builtin.is_none() && has_file {
            return Ok(file);
        }
        let others = ["src", "sha256", "frame", "raw"];
        self.left_aside(of, &others, "the built-in subject");
        let name = builtin.unwrap_or(DEFAULT_SUBJECT);
        Ok(VoxelSource::Builtin {
            name: name.to_owned(),
            revision: self.revision(of, name)?,
        })
    }

    fn clay_tool(&mut self, object: &Object<'_>) -> Result<ClayTool, DocumentError> {
        Ok(ClayTool {
            shape: self.shape_of_tool(object, ClayTool::default().shape)?,
            coat: self.exact(object, "coat")?,
        })
    }

    /// Says of the stroke of this index which of its tools are made of it or of later strokes.
    fn note_made_of_itself(
        &mut self,
        object: &Object<'_>,
        index: usize,
        stroke: &ClayStroke,
        tools: &[ClayTool],
    ) {
        for (i, one) in stroke.moves.iter().enumerate() {
            let tool = tools.get(one.tool);
            if tool.is_some_and(|tool| !tool.is_made_before(index)) {
                let at = match i {
                    0 => object.at("tool"),
                    _ => format!("{}/{}/tool", object.at("with"), i - 1),
                };
                let what = "a stroke by a tool that is made of it or of later strokes is";
                self.note(at, NoticeKind::NotDrawn { what });
            }
        }
    }

    /// A stroke of a clay with so many tools.
    fn clay_stroke(
        &mut self,
        object: &Object<'_>,
        tools: usize,
    ) -> Result<ClayStroke, DocumentError> {
        let mut moves = vec![self.clay_move(object, tools)?];
        for other in object.children("with")? {
            moves.push(self.clay_move(&other?, tools)?);
        }
        let mirror = self.mirror(object)?;
        let images = 1 << mirror.iter().filter(|is_on| **is_on).count();
        if moves.len() * images > Clay::MAX_AT_ONCE {
            return Err(DocumentError::TooMany {
                pointer: object.pointer.clone(),
                what: "tools at once, mirror images counted",
                found: moves.len() * images,
                limit: Clay::MAX_AT_ONCE,
            });
        }
        let strength = self.count(object, "strength")?;
        let done = self.choice_if_any(object, "do", "nothing")?;
        // What a later version does is not done as something else.
        let is_known = done.is_some() || !object.map.contains_key("do");
        Ok(ClayStroke {
            moves,
            mirror,
            smooth: (done == Some(1)).then_some(strength),
            is_off: object.flag("off")? || !is_known,
        })
    }

    /// A tool of a stroke, and its poses.
    fn clay_move(&mut self, object: &Object<'_>, tools: usize) -> Result<ClayMove, DocumentError> {
        self.unknown_keys(object);
        let tool = usize::try_from(object.whole("tool")?).unwrap_or(usize::MAX);
        if tool >= tools {
            let what = "a stroke by a tool that is not in the list is";
            self.note(object.at("tool"), NoticeKind::NotDrawn { what });
        }
        for (i, value) in object.list("path")?.iter().enumerate() {
            whole(&join(&object.at("path"), &i.to_string()), value)?;
        }
        let places = self.places(object, "path")?;
        let turns = self.turns(object, places.len())?;
        let scales = self.scales(object, places.len())?;
        let last = scales.last().copied().unwrap_or(WHOLE_SIZE);
        let keys = places.iter().enumerate().map(|(i, place)| ClayKey {
            at: place.to_array(),
            turn: turns.get(i).copied().unwrap_or_default(),
            percent: scales.get(i).copied().unwrap_or(last),
        });
        Ok(ClayMove {
            tool,
            keys: keys.collect(),
            is_straight: object.flag("straight")?,
        })
    }

    /// Rotation vectors of the first keys, degrees. One that is too long keeps its direction.
    fn turns(&mut self, object: &Object<'_>, keys: usize) -> Result<Vec<[i32; 3]>, DocumentError> {
        let longest = match object.kind("turns") {
            Kind::Wholes { max, .. } => max,
            _ => f64::MAX,
        };
        let numbers = self.wholes(object, "turns", keys)?;
        let mut turns = Vec::with_capacity(numbers.len() / 3);
        for (i, turn) in numbers.chunks_exact(3).enumerate() {
            let turn = [turn[0], turn[1], turn[2]];
            // Scaled first, so that no square overflows.
            let largest = turn.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
            let length = (DVec3::from_array(turn) / largest).length() * largest;
            let drawn = match length > longest {
                true => turn.map(|x| (x / length * longest).trunc()),
                false => turn,
            };
            let at = || join(&object.at("turns"), &(3 * i).to_string());
            turns.push(self.clamped(at, turn, drawn).map(|x| x as i32));
        }
        Ok(turns)
    }

    /// Sizes of the tool at the first keys, per cent.
    fn scales(&mut self, object: &Object<'_>, keys: usize) -> Result<Vec<i32>, DocumentError> {
        let range = match object.kind("scales") {
            Kind::Wholes { min, max, .. } => [min, max],
            _ => [f64::MIN, f64::MAX],
        };
        let mut scales = Vec::new();
        for (i, scale) in self.wholes(object, "scales", keys)?.into_iter().enumerate() {
            let at = || join(&object.at("scales"), &i.to_string());
            let [drawn] = self.clamp(at, [scale], range);
            scales.push(drawn as i32);
        }
        Ok(scales)
    }

    /// The whole numbers that a list has for the keys of a path; a notice says if it goes on beyond them.
    fn wholes(
        &mut self,
        object: &Object<'_>,
        key: &str,
        keys: usize,
    ) -> Result<Vec<f64>, DocumentError> {
        let (each, most) = match object.kind(key) {
            Kind::Wholes { each, most, .. } => (each, most),
            _ => (1, usize::MAX),
        };
        let (at, items) = (object.at(key), object.list(key)?);
        if items.len() % each != 0 {
            let expected = "a list of whole numbers, three for each key";
            return Err(wrong(&at, expected, &Value::Array(items.to_vec())));
        }
        let found = items.len() / each;
        if found > most {
            return Err(DocumentError::TooMany {
                pointer: at,
                what: "keys",
                found,
                limit: most,
            });
        }
        let numbers = items.iter().enumerate();
        let numbers = numbers.map(|(i, value)| whole(&join(&at, &i.to_string()), value));
        let mut numbers = numbers.collect::<Result<Vec<f64>, _>>()?;
        if found > keys {
            let (found, drawn) = (found.to_string(), format!("the first {keys}"));
            self.note(at, NoticeKind::Clamped { found, drawn });
            numbers.truncate(each * keys);
        }
        Ok(numbers)
    }
}

/// Reads a whole number.
fn whole(pointer: &str, value: &Value) -> Result<f64, DocumentError> {
    match number(pointer, value)? {
        whole if whole.fract() == 0.0 => Ok(whole),
        _ => Err(wrong(pointer, "a whole number", value)),
    }
}
