// The space of a template that is laid along a curve: W and its inverse. From the space of the straight box to the
// template's own and back.
// Source: Correa, section 5.3, eq. 5.1 and 5.3: W(s, t) bilinear along connected line segments, the third axis
// straight.
//
//      m0      m1        m2        W(s, t) = mix(p_i + t m_i, p_i+1 + t m_i+1, s) on segment i
//      |  t    |  s → __/          u, t: along and across the segment's line; the line beside it begins at t m_i and is
//      p0 ---- p1 ---p2            length + t (m_i+1 - m_i) · way long: s is where on that line the point lies
//
// Differs from the source: the corners' mitres in place of each segment's own normals, so that segments neither part
// nor overlap; the inverse in closed form in place of rasterised slices. Where several segments hold a point the
// nearest line decides; where none has room for it nothing is displaced. The first and the last segment go straight on.
// The processor (src/math/bent.rs) leaves in `templates.pool`, from the template's `curve` on: where the line begins
// along the box, its height, the number of segments (below 0 for a spline), the straight box's side along x; then per
// corner its place and its mitre. x and z in subject units from the corner of the straight box.
//
// For light the segments of a spline are taken as arcs (`rounds_splines`): the line rises over each segment by a cubic
// that is square to the mitres at both corners, so that a layer has one slope on both sides of a corner and no facets
// show. How much the map stretches along the line, 1 + t times the curvature of a segment, still steps from one segment
// to the next where the line's curvature does. What is where stays that of the straight segments.
// needs: types.wgsl bind/templates.wgsl displace/frame.wgsl

/// Least length of a segment beside the curve, as a fraction of its length on the curve. This and the next constant
/// stand in src/math/bent.rs too.
const LEAST_ROOM: f32 = 0.05;
const PAST_MITRE: f32 = 1e-4;

/// True while the map is asked for the slope of what is lit, and not for where it is.
var<private> rounds_splines: bool = false;

/// How far the line of a spline lies over its straight segment at a part of it, as a share of the segment's length
/// beside the line. `low`, `high`: lean of the mitres at both corners.
fn rise(part: f32, low: f32, high: f32) -> f32 {
    let left = 1.0 - part;
    return part * left * (high * part - low * left);
}

/// Where a point lies along and over the arc of a segment: from where it lies over the segment itself (`s`, `t`), by
/// steps that shrink with the square of the lean. `u`: along the segment.
fn on_arc(s: f32, u: f32, t: f32, segment: f32, low: f32, high: f32) -> vec2f {
    var found = vec2f(s, t);
    for (var turn = 0u; turn < 3u; turn++) {
        let part = found.x / segment;
        let room = segment + found.y * (high - low);
        found.y = t - room * rise(part, low, high);
        let new_room = segment + found.y * (high - low);
        found.x = clamp((u - found.y * low) / max(new_room, LEAST_ROOM * segment), 0.0, 1.0) * segment;
    }
    return found;
}

/// The template's own space; w is 0 where nothing of it is laid. `size`: sides of the box laid along the curve.
fn unbend(first: u32, size: vec3f, q: vec3f) -> vec4f {
    let head = templates.pool[first];
    let last = u32(abs(head.z));
    let is_round = rounds_splines && head.z < 0.0;
    let at = vec2f(q.x * head.w, q.z * size.z);
    var found = vec2f(0.0);
    var nearest = NO_END;
    var start = 0.0;
    var here = templates.pool[first + 1u];
    for (var i = 1u; i <= last; i++) {
        let next = templates.pool[first + 1u + i];
        let along = next.xy - here.xy;
        let segment = length(along);
        let way = along / segment;
        let u = dot(at - here.xy, way);
        let t = dot(at - here.xy, vec2f(-way.y, way.x));
        let low = t * dot(here.zw, way);
        let room = segment + t * dot(next.zw - here.zw, way);
        let has_room = room > LEAST_ROOM * segment;
        let part = (u - low) / select(segment, room, has_room);
        let is_beyond = (i == 1u && u < 0.0) || (i == last && u > segment);
        let is_inside = has_room && part >= -PAST_MITRE && part <= 1.0 + PAST_MITRE;
        if (is_beyond || is_inside) && abs(t) < nearest {
            nearest = abs(t);
            found = vec2f(start + select(clamp(part, 0.0, 1.0) * segment, u, is_beyond), t);
            if is_round && !is_beyond {
                found = on_arc(found.x - start, u, t, segment, dot(here.zw, way), dot(next.zw, way));
                found.x += start;
            }
        }
        start += segment;
        here = next;
    }
    let own = found + head.xy;
    return vec4f(own.x / size.x, q.y, own.y / size.z, select(0.0, 1.0, nearest < NO_END));
}

/// The inverse of `unbend`: from the template's own space, 0 to 1 in its box, to the space of the straight box.
fn bend(first: u32, size: vec3f, own: vec3f) -> vec3f {
    let head = templates.pool[first];
    let last = u32(abs(head.z));
    let is_round = rounds_splines && head.z < 0.0;
    let s = own.x * size.x - head.x;
    let t = own.z * size.z - head.y;
    var at = vec2f(0.0);
    var start = 0.0;
    var here = templates.pool[first + 1u];
    for (var i = 1u; i <= last; i++) {
        let next = templates.pool[first + 1u + i];
        let along = next.xy - here.xy;
        let segment = length(along);
        if i == 1u || s > start {
            let way = s - start;
            let part = clamp(way / segment, 0.0, 1.0);
            at = mix(here.xy + t * here.zw, next.xy + t * next.zw, part) + along / segment * (way - part * segment);
            if is_round {
                let ahead = along / segment;
                let low = dot(here.zw, ahead);
                let high = dot(next.zw, ahead);
                at += vec2f(-ahead.y, ahead.x) * ((segment + t * (high - low)) * rise(part, low, high));
            }
        }
        start += segment;
        here = next;
    }
    return vec3f(at.x / head.w, own.y, at.y / size.z);
}
