// Rigid segments: for each group whose constraint lets tissue move as a whole, the rigid motion that comes nearest to
// what the group would do to that tissue (Correa, section 5.7.2, second part: "the displacement should be the same for
// all points in that region").
//
// One workgroup per group: even places of the deformed space are asked where their material comes from; where it is the
// segment's, place and source are a pair. The rotation that best takes places to sources (least squares) is found by
// turning it towards the pairs' moments until it stays (Müller, Bender, Chentanez, Macklin 2016, "A robust method to
// extract the rotational part of deformations").
//
// Differs from the source: there a template's coordinate is held still over the region, kind by kind; this asks nothing
// of the kind.
// needs: types.wgsl affine.wgsl bind/templates.wgsl bind/kept.wgsl displace/compose.wgsl march/kept.wgsl

/// The motion of each group, subject space to rest space, at the index of its head.
@group(3) @binding(0) var<storage, read_write> motions: array<Affine, 32>;

/// Places along each side of the cube that is looked at, and its side: the subject has its longest side from −½ to ½.
const SIDE: u32 = 44u;
const SPAN: f32 = 1.3;
/// Turns at most; each is a Newton step, a dozen settle a right angle.
const TURNS: u32 = 40u;

/// xyz: sum of places; w: how many.
var<workgroup> places: array<vec4f, 64>;
/// Sum of sources, and of the products of each coordinate of a source with its place.
var<workgroup> sources: array<vec4f, 64>;
var<workgroup> products_x: array<vec4f, 64>;
var<workgroup> products_y: array<vec4f, 64>;
var<workgroup> products_z: array<vec4f, 64>;

fn matrix_of(q: vec4f) -> mat3x3f {
    return mat3x3f(
        1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y + q.w * q.z), 2.0 * (q.x * q.z - q.w * q.y),
        2.0 * (q.x * q.y - q.w * q.z), 1.0 - 2.0 * (q.x * q.x + q.z * q.z), 2.0 * (q.y * q.z + q.w * q.x),
        2.0 * (q.x * q.z + q.w * q.y), 2.0 * (q.y * q.z - q.w * q.x), 1.0 - 2.0 * (q.x * q.x + q.y * q.y),
    );
}

/// The rotation nearest to a matrix.
fn nearest_rotation(a: mat3x3f) -> mat3x3f {
    var q = vec4f(0.0, 0.0, 0.0, 1.0);
    for (var turn = 0u; turn < TURNS; turn++) {
        let r = matrix_of(q);
        let hold = abs(dot(r[0], a[0]) + dot(r[1], a[1]) + dot(r[2], a[2])) + 1e-12;
        let way = (cross(r[0], a[0]) + cross(r[1], a[1]) + cross(r[2], a[2])) / hold;
        let angle = length(way);
        if angle < 1e-7 {
            break;
        }
        let axis = way / angle * sin(0.5 * angle);
        let c = cos(0.5 * angle);
        q = normalize(vec4f(c * q.xyz + q.w * axis + cross(axis, q.xyz), c * q.w - dot(axis, q.xyz)));
    }
    return matrix_of(q);
}

@compute @workgroup_size(64)
fn fit(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    let head = group.x;
    let item = kept.items[head];
    let count = min(templates.count, 32u);
    var bits = 0u;
    for (var i = 0u; i < count; i++) {
        bits |= select(0u, 1u << i, templates.items[i].group == head);
    }
    let is_asked = item.constraint == CONSTRAIN_RIGID && head < count;
    var n = 0.0;
    var place = vec3f(0.0);
    var source = vec3f(0.0);
    var row_x = vec3f(0.0);
    var row_y = vec3f(0.0);
    var row_z = vec3f(0.0);
    for (var k = select(SIDE * SIDE * SIDE, lane, is_asked); k < SIDE * SIDE * SIDE; k += 64u) {
        let cell = vec3f(vec3u(k % SIDE, (k / SIDE) % SIDE, k / (SIDE * SIDE)));
        let pos = ((cell + 0.5) / f32(SIDE) - 0.5) * SPAN;
        let mapped = rest_from_subject(pos, bits);
        if mapped.continuity >= 0.0 && is_kept(mapped.pos, item.gives_way_to, 0.0) {
            n += 1.0;
            place += pos;
            source += mapped.pos;
            row_x += mapped.pos.x * pos;
            row_y += mapped.pos.y * pos;
            row_z += mapped.pos.z * pos;
        }
    }
    places[lane] = vec4f(place, n);
    sources[lane] = vec4f(source, 0.0);
    products_x[lane] = vec4f(row_x, 0.0);
    products_y[lane] = vec4f(row_y, 0.0);
    products_z[lane] = vec4f(row_z, 0.0);
    workgroupBarrier();
    if lane > 0u {
        return;
    }
    for (var k = 1u; k < 64u; k++) {
        n += places[k].w;
        place += places[k].xyz;
        source += sources[k].xyz;
        row_x += products_x[k].xyz;
        row_y += products_y[k].xyz;
        row_z += products_z[k].xyz;
    }
    var turn = mat3x3f(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    var shift = vec3f(0.0);
    // Fewer pairs have no rotation to speak of.
    if n > 7.5 {
        place /= n;
        source /= n;
        let moments = transpose(mat3x3f(
            row_x / n - source.x * place,
            row_y / n - source.y * place,
            row_z / n - source.z * place,
        ));
        turn = nearest_rotation(moments);
        shift = source - turn * place;
    }
    let rows = transpose(turn);
    motions[head] = Affine(vec4f(rows[0], shift.x), vec4f(rows[1], shift.y), vec4f(rows[2], shift.z));
}
