//! STL: binary, and ASCII with any number of solids.
//!
//! Its normals repeat the triangles and are often wrong: they are not taken.

use glam::Vec3;

use super::draft::{Corner, Draft};
use super::error::MeshError;
use super::format::{begins_solid, stl_len};
use super::input::{Input, Lines, shown, space_in};
use super::report::Aside;
use crate::data::NO_INDEX;

/// Reads an STL; the word for its form. It is binary if its length is 84 + 50 n, or if it does not begin with `solid`.
pub(super) fn read(
    input: &mut Input<'_, '_>,
    draft: &mut Draft,
    limit: u64,
) -> Result<&'static str, MeshError> {
    let start = input.peek(84)?;
    if begins_solid(start.trim_ascii_start()) && !has_binary_length(input, &start, limit)? {
        read_text(input, draft)?;
        return Ok("ASCII");
    }
    read_binary(input, draft)?;
    Ok("binary")
}

/// True if the length is that of a binary STL. Of a packed file it is not known: as many bytes are looked at as its
/// count asks for, if they may be read at all.
fn has_binary_length(
    input: &mut Input<'_, '_>,
    start: &[u8],
    limit: u64,
) -> Result<bool, MeshError> {
    let expected = match stl_len(start) {
        Some(expected) => expected,
        None => return Ok(start.len() == 84 && input.byte_len() == Some(84)),
    };
    if let Some(len) = input.byte_len() {
        return Ok(len == expected);
    }
    if expected > 84 + 50 * limit {
        return Ok(false);
    }
    Ok(input.peek(expected as usize + 1)?.len() as u64 == expected)
}

fn read_binary(input: &mut Input<'_, '_>, draft: &mut Draft) -> Result<(), MeshError> {
    let header: [u8; 84] = input.exact("the header of an STL")?;
    let [text @ .., a, b, c, d] = header;
    draft.space = space_in(&String::from_utf8_lossy(&text));
    let promised = u64::from(u32::from_le_bytes([a, b, c, d]));
    let part = draft.add_part("");
    let mut count: u64 = 0;
    let rest = loop {
        let mut triangle = [0; 50];
        let n = input.fill(&mut triangle)?;
        if n < triangle.len() {
            break n;
        }
        count += 1;
        // Triangles are counted before their corners, so that it is they that are too many.
        draft.has_room_for(1)?;
        let mut corners = [0; 3];
        for (corner, bytes) in corners.iter_mut().zip(triangle[12..48].chunks_exact(12)) {
            let float =
                |i: usize| f32::from_le_bytes([bytes[i], bytes[i + 1], bytes[i + 2], bytes[i + 3]]);
            *corner = draft.add_position(Vec3::new(float(0), float(4), float(8)))?;
        }
        if triangle[48..] != [0, 0] {
            draft.leave(Aside::Attributes);
        }
        draft.add_triangle(corners, part, NO_INDEX)?;
    };
    match (rest, count) {
        (0, count) if count == promised => Ok(()),
        // Whole triangles only: the count was never filled in, or not updated.
        (0, count) if count > 0 => {
            draft.leave(Aside::WrongCount);
            Ok(())
        }
        (_, count) if count >= promised => {
            draft.leave(Aside::TrailingBytes);
            draft.keep_triangles(promised as usize);
            Ok(())
        }
        _ => Err(input.ends(&format!("triangle {} of {promised}", count + 1))),
    }
}

fn read_text(input: &mut Input<'_, '_>, draft: &mut Draft) -> Result<(), MeshError> {
    let mut lines = Lines::new(input, 0);
    let mut part = None;
    let mut facet: Option<Vec<Corner>> = None;
    let mut has_solid = false;
    while lines.advance(false)? {
        let text = lines.text();
        let mut words = text.split_whitespace();
        let Some(first) = words.next() else { continue };
        match (first.to_ascii_lowercase().as_str(), part) {
            ("solid", None) => {
                let name = text.trim_start().get(5..).unwrap_or_default();
                draft.space = draft.space.or(space_in(name));
                part = Some(draft.add_part(name));
                has_solid = true;
            }
            ("facet", Some(_)) if facet.is_none() => {
                draft.has_room_for(1)?;
                facet = Some(Vec::new());
            }
            ("outer" | "endloop", Some(_)) if facet.is_some() => {}
            ("vertex", Some(_)) if let Some(corners) = &mut facet => {
                let mut position = [0.0; 3];
                for number in &mut position {
                    let word = words.next().unwrap_or_default();
                    *number =
                        word.parse()
                            .map_err(|_not_a_number: std::num::ParseFloatError| {
                                lines.wrong(format!("expected a number, found “{}”", shown(word)))
                            })?;
                }
                if corners.len() == crate::data::mesh::polygon::MAX_CORNERS {
                    return Err(
                        lines.wrong(format!("a facet of more than {} corners", corners.len()))
                    );
                }
                let position = draft.add_position(Vec3::from_array(position))?;
                corners.push(draft.corner(position));
            }
            ("endfacet", Some(part)) if let Some(corners) = facet.take() => {
                draft.add_face(&corners, part, NO_INDEX)?;
            }
            ("endsolid", Some(_)) if facet.is_none() => part = None,
            _ if part.is_none() && has_solid => {
                draft.leave(Aside::TrailingBytes);
                return Ok(());
            }
            _ => return Err(lines.wrong(expected(part.is_some(), facet.is_some()))),
        }
    }
    match part {
        None => Ok(()),
        Some(_) => Err(lines.wrong("the file ends before its endsolid")),
    }
}

/// What may come next in an ASCII STL.
fn expected(is_in_solid: bool, is_in_facet: bool) -> &'static str {
    match (is_in_solid, is_in_facet) {
        (_, true) => "expected vertex, endloop or endfacet",
        (true, false) => "expected facet or endsolid",
        (false, false) => "expected solid",
    }
}
