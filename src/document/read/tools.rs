//! Reading of what a `sweep` holds: its tools, their shapes and their paths.

use super::object::{Object, numbers, wrong};
use super::reader::Reader;
use crate::displace::{
    LONG, LONGEST, PathKey, ROUND, SOLID, SweepTool, SweepTools, ToolFile, ToolShape,
};
use crate::document::schema::{Kind, MAX_PAIR};
use crate::document::text::pointer::join;
use crate::document::text::{DocumentError, NoticeKind};
use glam::{DVec3, Vec3};
use serde_json::Value;

/// What a place in a list is called in a message.
const PLACE: &str = "a list of three numbers";

impl Reader {
    pub(super) fn sweep_tools(&mut self, params: &Object<'_>) -> Result<SweepTools, DocumentError> {
        let mut tools = SweepTools {
            mirror: self.mirror(params)?,
            ..SweepTools::default()
        };
        if !params.map.contains_key("tools") {
            return Ok(tools);
        }
        tools.tools.clear();
        let keys = params.kind("tools").keys();
        for (index, value) in self.first(params, "tools")?.iter().enumerate() {
            let pointer = join(&params.at("tools"), &index.to_string());
            let object = Object::new(pointer, value, keys)?;
            let tool = self.sweep_tool(&object, index)?;
            tools.tools.push(tool);
        }
        let known = tools.tools.iter().filter(|tool| tool.shape.is_some());
        let left_out: Vec<usize> = known
            .skip(tools.acting().count())
            .map(|t| t.index)
            .collect();
        for index in left_out {
            let what = "more than eight tools with their images are";
            let pointer = join(&params.at("tools"), &index.to_string());
            self.note(pointer, NoticeKind::NotDrawn { what });
        }
        Ok(tools)
    }

    /// The axes whose letters `mirror` has.
    pub(super) fn mirror(&mut self, object: &Object<'_>) -> Result<[bool; 3], DocumentError> {
        let letters = object.text("mirror")?.unwrap_or_default();
        if letters.chars().any(|letter| !"xyz".contains(letter)) {
            let instead = "each of the letters x, y and z in it";
            self.unknown_value(object.at("mirror"), letters, instead);
        }
        Ok(['x', 'y', 'z'].map(|letter| letters.contains(letter)))
    }

    fn sweep_tool(
        &mut self,
        object: &Object<'_>,
        index: usize,
    ) -> Result<SweepTool, DocumentError> {
        Ok(SweepTool {
            shape: self.shape_of_tool(object, SweepTool::default().shape)?,
            coat: self.number(object, "coat")?,
            spline: object.flag("spline")?,
            path: self.tool_path(object)?,
            index,
        })
    }

    /// The form of a tool; `None`, with a notice, for one that this version does not have. `ball` is the ball that
    /// nothing more is said of.
    pub(super) fn shape_of_tool(
        &mut self,
        object: &Object<'_>,
        ball: Option<ToolShape>,
    ) -> Result<Option<ToolShape>, DocumentError> {
        let mut shape = ball;
        let name = object.text("shape")?.unwrap_or(ToolShape::NAMES[0]);
        if name != ToolShape::NAMES[0] {
            let is_known = match object.kind("shape") {
                Kind::Name(names) => names.contains(&name),
                _ => false,
            };
            shape = ToolShape::named(name).filter(|_| is_known);
        }
        match &mut shape {
            Some(shape) => {
                self.unknown_keys(object);
                self.tool_shape(object, shape)?;
            }
            // What an unknown shape is told of is not known either.
            None => self.unknown_value(object.at("shape"), name, "nothing"),
        }
        Ok(shape)
    }

    fn tool_shape(
        &mut self,
        object: &Object<'_>,
        shape: &mut ToolShape,
    ) -> Result<(), DocumentError> {
        match shape {
            ToolShape::Ball { radius } => self.extent(object, "radius", radius, SOLID),
            ToolShape::Ellipsoid { radii } => self.extents(object, "radii", radii),
            ToolShape::Capsule { radius, length } => {
                self.extent(object, "radius", radius, ROUND)?;
                self.extent(object, "length", length, LONG)
            }
            ToolShape::Box { half, round } => {
                self.extents(object, "half", half)?;
                self.extent(object, "round", round, ROUND)?;
                let least = half.min_element();
                if *round > least && object.map.contains_key("round") {
                    let drawn = [f64::from(least)];
                    self.clamped(|| object.at("round"), [f64::from(*round)], drawn);
                }
                *round = round.min(least);
                Ok(())
            }
            ToolShape::Torus { ring, radius } => {
                self.extent(object, "ring", ring, SOLID)?;
                self.extent(object, "radius", radius, ROUND)
            }
            ToolShape::Curve { points, radius } => {
                self.extent(object, "radius", radius, ROUND)?;
                self.tool_points(object, points)
            }
            ToolShape::Mesh { file, longest } => {
                self.extent(object, "longest", longest, LONGEST)?;
                *file = self.tool_file(object)?;
                Ok(())
            }
            ToolShape::Clay { strokes, longest } => {
                self.extent(object, "longest", longest, LONGEST)?;
                *strokes = self.count(object, "strokes")?;
                Ok(())
            }
        }
    }

    /// The file of a tool that is a mesh; a notice says if none is named.
    fn tool_file(&mut self, object: &Object<'_>) -> Result<ToolFile, DocumentError> {
        let file = ToolFile {
            src: object.text("src")?.map(str::to_owned),
            sha256: object.hash()?,
            name: object.string("name")?,
            is_left_out: false,
        };
        if file.key().is_none() {
            let what = "a mesh of which no file is named is";
            self.note(object.pointer.clone(), NoticeKind::NotDrawn { what });
        }
        Ok(file)
    }

    /// A number of a shape; its default is what is there.
    fn extent(
        &mut self,
        object: &Object<'_>,
        key: &str,
        value: &mut f32,
        range: [f64; 2],
    ) -> Result<(), DocumentError> {
        if object.map.contains_key(key) {
            *value = self.number_in(object, key, f64::from(*value), range)?;
        }
        Ok(())
    }

    /// Three numbers of a shape; their default is what is there.
    fn extents(
        &mut self,
        object: &Object<'_>,
        key: &str,
        value: &mut Vec3,
    ) -> Result<(), DocumentError> {
        if let Some(given) = object.numbers(key, PLACE)? {
            let drawn = self.clamp(|| object.at(key), given, SOLID);
            *value = DVec3::from_array(drawn).as_vec3();
        }
        Ok(())
    }

    fn tool_points(
        &mut self,
        object: &Object<'_>,
        points: &mut Vec<Vec3>,
    ) -> Result<(), DocumentError> {
        let Some(given) = object.map.get("points") else {
            return Ok(());
        };
        let list = self.first(object, "points")?;
        if list.len() < 2 {
            let expected = "a list of two points or more";
            return Err(wrong(&object.at("points"), expected, given));
        }
        let Kind::Triples { max, .. } = object.kind("points") else {
            return Ok(());
        };
        points.clear();
        for (i, value) in list.iter().enumerate() {
            let pointer = join(&object.at("points"), &i.to_string());
            let point: [f64; 3] = numbers(&pointer, value, PLACE)?;
            let drawn = self.clamp(|| pointer, point, [-max, max]);
            points.push(DVec3::from_array(drawn).as_vec3());
        }
        Ok(())
    }

    fn tool_path(&mut self, object: &Object<'_>) -> Result<Vec<PathKey>, DocumentError> {
        let Some(given) = object.map.get("path") else {
            return Ok(PathKey::PRESS.to_vec());
        };
        let list = self.first(object, "path")?;
        if list.is_empty() {
            return Err(wrong(
                &object.at("path"),
                "a list of one key or more",
                given,
            ));
        }
        let keys = object.kind("path").keys();
        let mut path = Vec::with_capacity(list.len());
        for (i, value) in list.iter().enumerate() {
            let pointer = join(&object.at("path"), &i.to_string());
            path.push(match value {
                Value::Object(_) => {
                    let key = Object::new(pointer, value, keys)?;
                    self.unknown_keys(&key);
                    PathKey {
                        at: self.vector(&key, "at")?,
                        rotate: self.rotation(&key, "rotate")?,
                        scale: self.number(&key, "scale")?,
                    }
                }
                Value::Array(_) => {
                    let place: [f64; 3] = numbers(&pointer, value, PLACE)?;
                    let drawn = self.clamp(|| pointer, place, [-MAX_PAIR, MAX_PAIR]);
                    PathKey::at(DVec3::from_array(drawn).as_vec3())
                }
                other => return Err(wrong(&pointer, "a place or an object", other)),
            });
        }
        Ok(path)
    }
}
