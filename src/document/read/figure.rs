//! Reads how a figure is divided and bent.

use super::object::{Object, number, numbers, wrong};
use super::reader::Reader;
use crate::document::limits::MAX_BYTES;
use crate::document::model::figure::{
    Behind, Context, Contour, Figure, Flood, Handle, Hold, MAX_FLOOD_POINTS, MAX_TURN, Move,
    Propagation, RIGIDITY_RANGE, Region, Rest, Rigidity, Rotations, Source,
};
use crate::document::schema::{FIGURE, Kind, LeftOut, find};
use crate::document::text::pointer::join;
use crate::document::text::{DocumentError, NoticeKind, json, shortened};
use glam::DVec2;
use serde_json::Value;
use std::collections::HashSet;

/// Reads a figure from JSON text that holds what stands under `figure` in a document, at most 1 MiB. Values outside
/// their range are brought into it. It is how a figure crosses to a worker; see [`figure_to_text`].
///
/// # Errors
/// The first fault, named by its pointer in a document (`/figure/handles/0/move`).
///
/// [`figure_to_text`]: crate::document::figure_to_text
pub fn figure_from_text(text: &str) -> Result<Figure, DocumentError> {
    if text.len() > MAX_BYTES {
        return Err(DocumentError::TooLarge {
            found: text.len(),
            limit: MAX_BYTES,
        });
    }
    let value = json::read(text)?;
    let object = Object::new("/figure".to_owned(), &value, FIGURE)?;
    Reader::default().figure(&object)
}

/// Keys of a region that a source's own region has too.
const REGION_KEYS: [&str; 10] = [
    "grow", "smooth", "fill", "least", "rigidity", "fixed", "order", "cut", "behind", "hide",
];

impl Reader {
    /// The key `figure` of a document.
    pub(super) fn figure(&mut self, object: &Object<'_>) -> Result<Figure, DocumentError> {
        self.unknown_keys(object);
        let regions = self.regions(object)?;
        let mut handles = Vec::new();
        for handle in object.children("handles")? {
            handles.push(self.handle(&handle?)?);
        }
        let only = self.points_of(object, "only")?;
        let propagation = Propagation::ALL[self.choice(object, "propagation")?];
        let reach = self.exact(object, "reach")?;
        let rotations = Rotations::ALL[self.choice(object, "rotations")?];
        let context = self.context(&object.child("context")?)?;
        let mut contours = Vec::new();
        for contour in object.children("contours")? {
            contours.push(self.contour(&contour?)?);
        }
        Ok(Figure {
            regions,
            handles,
            only: Some(only).filter(|points| !points.is_empty()),
            propagation,
            reach,
            rotations,
            context,
            contours,
            rest: Rest::ALL[self.choice(object, "rest")?],
            detail: self.count(object, "detail")?,
        })
    }

    fn regions(&mut self, figure: &Object<'_>) -> Result<Vec<Region>, DocumentError> {
        let mut regions: Vec<Region> = Vec::new();
        // `rest` is what lies in no region.
        let mut taken = HashSet::from(["rest".to_owned()]);
        let mut flood_points = 0;
        for (index, object) in figure.children("regions")?.enumerate() {
            let object = object?;
            let region = self.region(index, &object)?;
            if !taken.insert(region.name.clone()) {
                return Err(DocumentError::TakenName {
                    pointer: match object.map.contains_key("name") {
                        true => object.at("name"),
                        false => object.pointer,
                    },
                    name: shortened(&region.name, 40),
                });
            }
            if let Some(Source::Flood(flood)) = &region.from {
                flood_points += flood.at.len();
            }
            regions.push(region);
        }
        if flood_points > MAX_FLOOD_POINTS {
            return Err(DocumentError::TooMany {
                pointer: figure.at("regions"),
                what: "points of all floods together",
                found: flood_points,
                limit: MAX_FLOOD_POINTS,
            });
        }
        Ok(regions)
    }

    fn region(&mut self, index: usize, object: &Object<'_>) -> Result<Region, DocumentError> {
        self.unknown_keys(object);
        let name = match object.string("name")? {
            name if name.is_empty() => format!("region {}", index + 1),
            name => name,
        };
        let from = match object.map.contains_key("from") {
            true => self.source(&object.child("from")?)?,
            false => None,
        };
        let is_given = |key: &&str| from.is_none() && object.map.contains_key(*key);
        let given = REGION_KEYS.into_iter().filter(is_given).collect();
        Ok(Region {
            name,
            from,
            grow: self.exact(object, "grow")?,
            smooth: self.exact(object, "smooth")?,
            fill: object.flag_if_any("fill")?,
            least: self.count(object, "least")?,
            rigidity: self.rigidity(object)?,
            fixed: object.flag("fixed")?,
            order: self.exact(object, "order")?,
            cut: object.flag("cut")?,
            behind: self.behind(object)?,
            hide: object.flag("hide")?,
            given,
        })
    }

    /// A region's `from`. One that only a later version knows gives nothing; its key is named.
    fn source(&mut self, object: &Object<'_>) -> Result<Option<Source>, DocumentError> {
        self.unknown_keys(object);
        let given = one_of(object, "exactly one of `flood`, `polygon` and `path`")?;
        Ok(match given {
            Some("flood") => {
                let flood = object.child("flood")?;
                self.unknown_keys(&flood);
                Some(Source::Flood(Flood {
                    at: self.points_of(&flood, "at")?,
                    tolerance: self.exact(&flood, "tolerance")?,
                    gap: self.exact(&flood, "gap")?,
                    connected: flood.flag("connected")?,
                }))
            }
            Some("polygon") => Some(Source::Polygon(self.points_of(object, "polygon")?)),
            Some("path") => match object.map.get("path") {
                Some(Value::String(id)) => Some(Source::Path(id.clone())),
                Some(Value::Number(shape)) if shape.is_u64() => {
                    Some(Source::Path(shape.to_string()))
                }
                other => {
                    let expected = "an element's id or the number of a shape";
                    return Err(wrong(
                        &object.at("path"),
                        expected,
                        other.unwrap_or(&Value::Null),
                    ));
                }
            },
            _ => None,
        })
    }

    fn rigidity(&mut self, object: &Object<'_>) -> Result<Rigidity, DocumentError> {
        let pointer = object.at("rigidity");
        let values = match object.map.get("rigidity") {
            None => return Ok(Rigidity::SOFT),
            Some(Value::String(name)) => {
                if name != "rigid" {
                    self.unknown_value(pointer, name, "1");
                    return Ok(Rigidity::SOFT);
                }
                return Ok(Rigidity::Rigid);
            }
            Some(value @ Value::Number(_)) => {
                let value = number(&pointer, value)?;
                let [drawn] = self.clamp(|| pointer, [value], RIGIDITY_RANGE);
                return Ok(Rigidity::Elastic([drawn; 2]));
            }
            Some(value) => numbers(
                &pointer,
                value,
                "a number, a list of two numbers or “rigid”",
            )?,
        };
        Ok(Rigidity::Elastic(self.clamp(
            || pointer,
            values,
            RIGIDITY_RANGE,
        )))
    }

    fn behind(&mut self, object: &Object<'_>) -> Result<Behind, DocumentError> {
        Ok(match object.text("behind")? {
            None | Some("none") => Behind::None,
            Some("smooth") => Behind::Smooth,
            Some(_) => {
                let color = self.color(object, "behind", "none")?;
                color.map_or(Behind::None, Behind::Color)
            }
        })
    }

    fn handle(&mut self, object: &Object<'_>) -> Result<Handle, DocumentError> {
        self.unknown_keys(object);
        let expected = "exactly one of `at`, `region` and `points`";
        let given: Vec<&str> = ["at", "region", "points"]
            .into_iter()
            .filter(|key| object.map.contains_key(*key))
            .collect();
        let [holds] = given.as_slice() else {
            return Err(not_one(object, expected, &given));
        };
        // Read in any case, so that a fault is named.
        if *holds != "points" && object.map.contains_key("to") {
            self.points_of(object, "to")?;
        }
        let motion = Move {
            by: self.point(object, "move")?,
            turn: self.turn(object)?,
            scale: self.exact(object, "scale")?,
        };
        let still = Move {
            turn: Some(0.0),
            ..Move::default()
        };
        let (hold, motion) = match *holds {
            "at" => (Hold::Point(self.point(object, "at")?), motion),
            "region" => (Hold::Region(object.string("region")?), motion),
            _ => {
                let points = self.points_of(object, "points")?;
                let to = match object.map.contains_key("to") {
                    true => Some(self.as_many(object, "to", points.len())?),
                    false => None,
                };
                let motion = if to.is_some() { still } else { motion };
                (Hold::Line { points, to }, motion)
            }
        };
        let leads = matches!(&hold, Hold::Line { to: Some(_), .. });
        let (left_aside, taken): (&[&str], _) = match leads {
            true => (&["move", "turn", "scale"], "`to`"),
            false => (&["to"], "`move`"),
        };
        for key in left_aside {
            if object.map.contains_key(*key) {
                self.note(object.at(key), NoticeKind::LeftAside { taken });
            }
        }
        let turn = match hold {
            Hold::Point(_) => motion.turn,
            Hold::Region(_) | Hold::Line { .. } => Some(motion.turn.unwrap_or(0.0)),
        };
        Ok(Handle {
            name: Some(object.string("name")?).filter(|name| !name.is_empty()),
            hold,
            radius: self.exact(object, "radius")?,
            motion: Move { turn, ..motion },
            enabled: object.flag("enabled")?,
        })
    }

    /// A handle's turn; `None` where it is not given.
    fn turn(&mut self, handle: &Object<'_>) -> Result<Option<f64>, DocumentError> {
        let pointer = || handle.at("turn");
        let value = match handle.map.get("turn") {
            None | Some(Value::Null) => return Ok(None),
            Some(value) => number(&pointer(), value)?,
        };
        let [drawn] = self.clamp(pointer, [value], [-MAX_TURN, MAX_TURN]);
        Ok(Some(drawn))
    }

    /// The context; `None` if it has no points.
    fn context(&mut self, object: &Object<'_>) -> Result<Option<Context>, DocumentError> {
        self.unknown_keys(object);
        let points = self.points_of(object, "points")?;
        let like = match object.list("like")? {
            [] => None,
            _ => Some(self.as_many(object, "like", points.len())?),
        };
        let context = Context {
            points,
            strength: self.exact(object, "strength")?,
            keep: object.flag("keep")?,
            like,
            amount: self.exact(object, "amount")?,
        };
        Ok(Some(context).filter(|context| !context.points.is_empty()))
    }

    fn contour(&mut self, object: &Object<'_>) -> Result<Contour, DocumentError> {
        self.unknown_keys(object);
        Ok(Contour {
            region: object.string("region")?,
            like: self.points_of(object, "like")?,
            amount: self.exact(object, "amount")?,
            mirror: object.flag("mirror")?,
            keep: self.points_of(object, "keep")?,
        })
    }

    /// Two numbers of the schema, in their range; 0 and 0 if the key is missing.
    fn point(&mut self, object: &Object<'_>, key: &str) -> Result<DVec2, DocumentError> {
        let Kind::Point { max } = object.kind(key) else {
            debug_assert!(false, "{key} is no point in the schema");
            return Ok(DVec2::ZERO);
        };
        let values = object.numbers(key, "a list of two numbers")?;
        let drawn = self.clamp(|| object.at(key), values.unwrap_or_default(), [-max, max]);
        Ok(DVec2::from_array(drawn))
    }

    /// The points of a list of the schema, each number in its range; none if the key may be left out and is.
    ///
    /// # Errors
    /// If there are too few or too many.
    fn points_of(&mut self, object: &Object<'_>, key: &str) -> Result<Vec<DVec2>, DocumentError> {
        let Kind::Points { least, most, max } = object.kind(key) else {
            debug_assert!(false, "{key} is no list of points in the schema");
            return Ok(Vec::new());
        };
        let items = object.list(key)?;
        let (pointer, what, found) = (object.at(key), "points", items.len());
        let may_be_left_out =
            find(object.keys, key).is_some_and(|key| key.left_out == LeftOut::AtDefault);
        if found < least && !(found == 0 && may_be_left_out) {
            return Err(DocumentError::TooFew {
                pointer,
                what,
                found,
                least,
            });
        }
        if found > most {
            return Err(DocumentError::TooMany {
                pointer,
                what,
                found,
                limit: most,
            });
        }
        let mut points = Vec::with_capacity(found);
        for (i, value) in items.iter().enumerate() {
            let pointer = join(&pointer, &i.to_string());
            let pair = numbers(&pointer, value, "a list of two numbers")?;
            let drawn = self.clamp(|| pointer, pair, [-max, max]);
            points.push(DVec2::from_array(drawn));
        }
        Ok(points)
    }

    /// The points of a list that goes with `points`, of which there are `expected`.
    fn as_many(
        &mut self,
        object: &Object<'_>,
        key: &str,
        expected: usize,
    ) -> Result<Vec<DVec2>, DocumentError> {
        let found = object.list(key)?.len();
        match found == expected {
            true => self.points_of(object, key),
            false => Err(DocumentError::UnequalLengths {
                pointer: object.at(key),
                found,
                expected,
            }),
        }
    }
}

/// The one key of an object that the schema has; `None` if there are only others.
fn one_of(
    object: &Object<'_>,
    expected: &'static str,
) -> Result<Option<&'static str>, DocumentError> {
    let known = object.keys.iter().map(|key| key.name);
    let given: Vec<&str> = known.filter(|key| object.map.contains_key(*key)).collect();
    match given.as_slice() {
        [one] => Ok(Some(*one)),
        [] if !object.map.is_empty() => Ok(None),
        _ => Err(not_one(object, expected, &given)),
    }
}

/// The error for an object with none or several of keys of which it has one.
fn not_one(object: &Object<'_>, expected: &'static str, given: &[&str]) -> DocumentError {
    let quoted: Vec<String> = given.iter().map(|key| format!("`{key}`")).collect();
    DocumentError::WrongType {
        pointer: object.pointer.clone(),
        expected,
        found: match quoted.is_empty() {
            true => "none of them".to_owned(),
            false => quoted.join(" and "),
        },
    }
}
