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
// along the box, its height, the number of segments, the straight box's side along x; then per corner its place and its
// mitre. x and z in subject units from the corner of the straight box.
// needs: types.wgsl bind/templates.wgsl displace/frame.wgsl

/// Least length of a segment beside the curve, as a fraction of its length on the curve. This and the next constant
/// stand in src/math/bent.rs too.
const LEAST_ROOM: f32 = 0.05;
const PAST_MITRE: f32 = 1e-4;

/// The template's own space; w is 0 where nothing of it is laid. `size`: sides of the box laid along the curve.
fn unbend(first: u32, size: vec3f, q: vec3f) -> vec4f {
    let head = templates.pool[first];
    let last = u32(head.z);
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
    let last = u32(head.z);
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
        }
        start += segment;
        here = next;
    }
    return vec3f(at.x / head.w, own.y, at.y / size.z);
}
