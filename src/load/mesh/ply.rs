//! PLY: ASCII and both binary orders.

use std::fmt;

use glam::{Vec2, Vec3};

use super::draft::{Corner, Draft};
use super::error::MeshError;
use super::input::{Input, Lines, shown};
use super::mtl::linear;
use super::ply_header::{Element, Form, Property, Scalar, read as read_header};
use super::report::Aside;
use crate::data::NO_INDEX;
use crate::data::mesh::polygon::MAX_CORNERS;

/// Reads a PLY; the word for its form.
pub(super) fn read(
    input: &mut Input<'_, '_>,
    draft: &mut Draft,
    name: &str,
) -> Result<&'static str, MeshError> {
    let header = read_header(input, name)?;
    draft.space = header.space;
    if header.names_texture {
        draft.leave(Aside::NamedTexture);
    }
    let vertices = header
        .elements
        .iter()
        .find(|element| element.name == "vertex");
    let mut reader = Reader {
        vertex_count: vertices.map_or(0, |element| element.count),
        part: draft.add_part(""),
        draft,
    };
    match header.form {
        Form::Ascii => {
            let lines = Lines::new(input, header.line_count);
            let mut words = Words {
                lines,
                line: String::new(),
                at: 0,
            };
            for element in &header.elements {
                reader.element(element, &mut words)?;
            }
            if words.next_line()? {
                reader.draft.leave(Aside::TrailingBytes);
            }
            Ok("ASCII")
        }
        Form::Binary { is_big } => {
            let mut bytes = Bytes { input, is_big };
            for element in &header.elements {
                reader.element(element, &mut bytes)?;
            }
            Ok(if is_big {
                "binary, high byte first"
            } else {
                "binary"
            })
        }
    }
}

/// Where numbers come from.
trait Numbers {
    /// Goes to the next element.
    fn begin(&mut self, what: &dyn fmt::Display) -> Result<(), MeshError>;
    /// The next number of the element.
    fn next(&mut self, scalar: Scalar, what: &str) -> Result<f64, MeshError>;
    /// Passes over all of an element.
    fn skip(&mut self, element: &Element) -> Result<(), MeshError>;
    /// That the last number, or what it leads to, cannot be.
    fn wrong(&self, what: String) -> MeshError;

    /// Passes over the items of a list, or a single number.
    fn skip_property(&mut self, property: &Property, what: &str) -> Result<(), MeshError> {
        let count = match property.count {
            None => 1,
            Some(count) => self.count(count, what)?,
        };
        for _ in 0..count {
            self.next(property.item, what)?;
        }
        Ok(())
    }

    /// The count of a list.
    fn count(&mut self, scalar: Scalar, what: &str) -> Result<u64, MeshError> {
        let count = self.next(scalar, what)?;
        match count >= 0.0 && count.fract() == 0.0 {
            true => Ok(count as u64),
            false => Err(self.wrong(format!("a list of {count} items"))),
        }
    }
}

/// The words of an ASCII body: an element is a line.
struct Words<'i, 's, 'f> {
    lines: Lines<'i, 's, 'f>,
    line: String,
    /// Bytes of the line that were taken.
    at: usize,
}

impl Words<'_, '_, '_> {
    /// Goes to the next line that is not blank; false at the end.
    fn next_line(&mut self) -> Result<bool, MeshError> {
        while self.lines.advance(false)? {
            if !self.lines.text().trim_start().is_empty() {
                self.line.clear();
                self.line.push_str(&self.lines.text());
                self.at = 0;
                return Ok(true);
            }
        }
        Ok(false)
    }
}

impl Numbers for Words<'_, '_, '_> {
    fn begin(&mut self, what: &dyn fmt::Display) -> Result<(), MeshError> {
        match self.next_line()? {
            true => Ok(()),
            false => Err(self.wrong(format!("the file ends before {what}"))),
        }
    }

    fn next(&mut self, scalar: Scalar, what: &str) -> Result<f64, MeshError> {
        let rest = self.line[self.at..].trim_start();
        let start = self.line.len() - rest.len();
        let word = rest.split(char::is_whitespace).next().unwrap_or_default();
        if word.is_empty() {
            return Err(self.wrong(format!("the line ends in {what}")));
        }
        self.at = start + word.len();
        // As 32 bits where the header says so: rounded once.
        let number = match scalar {
            Scalar::F32 => word.parse::<f32>().map(f64::from),
            _ => word.parse::<f64>(),
        };
        number.map_err(|_not_a_number| {
            self.wrong(format!("expected a number, found “{}”", shown(word)))
        })
    }

    fn skip(&mut self, element: &Element) -> Result<(), MeshError> {
        for index in 0..element.count {
            self.begin(&Where("element", index, element.count))?;
        }
        Ok(())
    }

    fn wrong(&self, what: String) -> MeshError {
        self.lines.wrong(what)
    }
}

/// A binary body.
struct Bytes<'i, 's, 'f> {
    input: &'i mut Input<'s, 'f>,
    is_big: bool,
}

impl Numbers for Bytes<'_, '_, '_> {
    fn begin(&mut self, _what: &dyn fmt::Display) -> Result<(), MeshError> {
        Ok(())
    }

    fn next(&mut self, scalar: Scalar, what: &str) -> Result<f64, MeshError> {
        let mut bytes = [0; 8];
        let wanted = &mut bytes[..scalar.size()];
        match self.input.fill(wanted)? {
            n if n == scalar.size() => Ok(scalar.decode(bytes, self.is_big)),
            _ => Err(self.input.ends(what)),
        }
    }

    fn skip(&mut self, element: &Element) -> Result<(), MeshError> {
        if let Some(size) = element.size() {
            let bytes = size.saturating_mul(element.count);
            return match self.input.skip(bytes)? {
                n if n == bytes => Ok(()),
                _ => Err(self.input.ends("what is passed over")),
            };
        }
        for _ in 0..element.count {
            for property in &element.properties {
                let Some(count) = property.count else {
                    self.next(property.item, "what is passed over")?;
                    continue;
                };
                let count = self.count(count, "what is passed over")?;
                let bytes = count.saturating_mul(property.item.size() as u64);
                if self.input.skip(bytes)? < bytes {
                    return Err(self.input.ends("what is passed over"));
                }
            }
        }
        Ok(())
    }

    fn wrong(&self, what: String) -> MeshError {
        self.input.at_byte(self.input.position(), what)
    }
}

/// What a property of a vertex is for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    Position(usize),
    Normal(usize),
    Color(usize),
    Uv(usize),
}

fn role(name: &str) -> Option<Role> {
    Some(match name {
        "x" => Role::Position(0),
        "y" => Role::Position(1),
        "z" => Role::Position(2),
        "nx" => Role::Normal(0),
        "ny" => Role::Normal(1),
        "nz" => Role::Normal(2),
        "red" => Role::Color(0),
        "green" => Role::Color(1),
        "blue" => Role::Color(2),
        "s" | "u" | "texture_u" => Role::Uv(0),
        "t" | "v" | "texture_v" => Role::Uv(1),
        _ => return None,
    })
}

fn is_corner_list(property: &Property) -> bool {
    property.count.is_some() && matches!(property.name.as_str(), "vertex_indices" | "vertex_index")
}

struct Reader<'d> {
    draft: &'d mut Draft,
    /// Vertices that the header promises: what corners may name.
    vertex_count: u64,
    part: u32,
}

impl Reader<'_> {
    fn element(&mut self, element: &Element, numbers: &mut dyn Numbers) -> Result<(), MeshError> {
        if element.properties.is_empty() {
            // Nothing is written of such elements, however many there are.
            return Ok(());
        }
        let has_corners = element.properties.iter().any(is_corner_list);
        match element.name.as_str() {
            "vertex" => self.vertices(element, numbers),
            "face" if has_corners => self.faces(element, numbers),
            "tristrips" if has_corners => self.strips(element, numbers),
            _ => numbers.skip(element),
        }
    }

    fn vertices(&mut self, element: &Element, numbers: &mut dyn Numbers) -> Result<(), MeshError> {
        let roles: Vec<Option<Role>> = element
            .properties
            .iter()
            .map(|property| role(&property.name).filter(|_| property.count.is_none()))
            .collect();
        let has = |wanted: &[Role]| wanted.iter().all(|role| roles.contains(&Some(*role)));
        if !has(&[Role::Position(0), Role::Position(1), Role::Position(2)]) {
            return Err(numbers.wrong("the vertices have no x, y and z".to_owned()));
        }
        let has_normal = has(&[Role::Normal(0), Role::Normal(1), Role::Normal(2)]);
        let has_color = has(&[Role::Color(0), Role::Color(1), Role::Color(2)]);
        let has_uv = has(&[Role::Uv(0), Role::Uv(1)]);
        for index in 0..element.count {
            let what = Where("vertex", index, element.count);
            numbers.begin(&what)?;
            let (mut position, mut normal, mut color, mut uv) =
                ([0.0f32; 3], [0.0; 3], [0.0; 3], [0.0; 2]);
            for (property, role) in element.properties.iter().zip(&roles) {
                let Some(role) = role else {
                    numbers.skip_property(property, "a vertex")?;
                    continue;
                };
                let value = numbers.next(property.item, "a vertex")? as f32;
                match *role {
                    Role::Position(i) => position[i] = value,
                    Role::Normal(i) => normal[i] = value,
                    Role::Color(i) => color[i] = value / property.item.one(),
                    Role::Uv(i) => uv[i] = value,
                }
            }
            self.draft.add_position(Vec3::from_array(position))?;
            if has_color {
                let is_finite = color.iter().all(|x| x.is_finite());
                self.draft
                    .color_last(if is_finite { linear(color) } else { Vec3::NAN });
            }
            if has_normal {
                self.draft.add_normal(Vec3::from_array(normal))?;
            }
            if has_uv {
                self.draft.add_uv(Vec2::new(uv[0], 1.0 - uv[1]))?;
            }
        }
        Ok(())
    }

    /// The index of a corner.
    fn index(&self, number: f64, numbers: &dyn Numbers) -> Result<u32, MeshError> {
        let is_there = number >= 0.0 && number < self.vertex_count as f64 && number.fract() == 0.0;
        match is_there && number < f64::from(NO_INDEX) {
            true => Ok(number as u32),
            false => Err(numbers.wrong(format!(
                "vertex {number} is out of range: there are {}",
                self.vertex_count
            ))),
        }
    }

    fn faces(&mut self, element: &Element, numbers: &mut dyn Numbers) -> Result<(), MeshError> {
        if element.properties.len() > 1 {
            self.draft.leave(Aside::FaceProperties);
        }
        let mut corners: Vec<Corner> = Vec::new();
        for index in 0..element.count {
            let what = Where("face", index, element.count);
            numbers.begin(&what)?;
            for property in &element.properties {
                let Some(count) = property.count.filter(|_| is_corner_list(property)) else {
                    numbers.skip_property(property, "a face")?;
                    continue;
                };
                let count = numbers.count(count, "a face")?;
                if count > MAX_CORNERS as u64 {
                    return Err(numbers.wrong(format!(
                        "a face of {count} corners: {MAX_CORNERS} are the most"
                    )));
                }
                corners.clear();
                for _ in 0..count {
                    let number = numbers.next(property.item, "a face")?;
                    let index = self.index(number, numbers)?;
                    corners.push(self.corner(index));
                }
                self.draft.add_face(&corners, self.part, NO_INDEX)?;
            }
        }
        Ok(())
    }

    /// A corner; its values are there, or will be when the vertices stand behind the faces.
    fn corner(&self, index: u32) -> Corner {
        Corner {
            position: index,
            uv: index,
            normal: index,
        }
    }

    /// Strips of triangles, every second one turned over; −1 begins a new one.
    fn strips(&mut self, element: &Element, numbers: &mut dyn Numbers) -> Result<(), MeshError> {
        for index in 0..element.count {
            let what = Where("strip", index, element.count);
            numbers.begin(&what)?;
            for property in &element.properties {
                let Some(count) = property.count.filter(|_| is_corner_list(property)) else {
                    numbers.skip_property(property, "a strip")?;
                    continue;
                };
                let mut strip: Vec<u32> = Vec::with_capacity(3);
                let mut is_odd = false;
                for _ in 0..numbers.count(count, "a strip")? {
                    let number = numbers.next(property.item, "a strip")?;
                    if number == -1.0 {
                        strip.clear();
                        is_odd = false;
                        continue;
                    }
                    strip.push(self.index(number, numbers)?);
                    let &[a, b, c] = &strip[..] else { continue };
                    let turned = if is_odd { [b, a, c] } else { [a, b, c] };
                    self.draft
                        .add_face(&turned.map(|i| self.corner(i)), self.part, NO_INDEX)?;
                    strip.remove(0);
                    is_odd = !is_odd;
                }
            }
        }
        Ok(())
    }
}

/// Which of how many elements, for a message.
struct Where(&'static str, u64, u64);

impl fmt::Display for Where {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} of {}", self.0, self.1 + 1, self.2)
    }
}
