// The way of a ray through meshes: the untouched triangles say what is met, wherever the map leads.
//
//   eye --o--------o-----o--o-o×-o        o a place on the ray and where it was at rest; × a triangle
//            long steps while no triangle is near
//
// Between two places the ray is a curve in rest space. Where the field says that a triangle may be between them, the
// curve is followed by short chords, each chord is tested against the triangles, and a crossing is made exact along the
// true curve. Gaps (A < 0) and jumps of the map are found by bisection before that; the wall of a gap is a cut face
// where it meets the inside of a body.
// Source: Correa, sections 7.4 and 7.5.2 (adaptive sampling), with triangles in the place of a sampled field.
// Differs from the source: one rule for the deformed part and the rest, exact edges, no blending at borders.
// needs: types.wgsl affine.wgsl bind/frame.wgsl bind/subject.wgsl bind/mesh_look.wgsl displace/compose.wgsl
//   march/overrides.wgsl march/shade.wgsl march/sample.wgsl march/seek.wgsl march/jacobian.wgsl march/surface.wgsl
//   march/marched.wgsl march/gathered.wgsl march/textures.wgsl subject/mesh.wgsl subject/crossing.wgsl
//   march/filling.wgsl
//   march/plain.wgsl|march/align.wgsl|march/baked.wgsl

/// Surfaces that count on one ray (spec/surfaces.md, "What the object has at a point").
const MAX_CROSSINGS: u32 = 16u;
/// Steps of one ray at most; a guard.
const MAX_STEPS: u32 = 3000u;
/// Longest chord that is tested against triangles, rest space units: with such chords no ray in 500 goes wrong under a
/// twist and a narrow pull.
const LONGEST_CHORD: f32 = 0.00390625;
/// Longest and shortest step where a template acts, and the step in gaps, subject units.
const LONGEST_STEP: f32 = 0.015;
const SHORTEST_STEP: f32 = 0.00002;
const GAP_STEP: f32 = 0.003;
/// Halvings of a step to find where a gap or a jump begins.
const MESH_BISECTIONS: u32 = 12u;
/// A jump of the map is farther than this, rest space units.
const LEAST_JUMP: f32 = 0.0001;
/// Step inside of shells, whose inner walls the field does not tell of, subject units.
const SHELL_STEP: f32 = 0.004;

/// A place on the ray.
struct Spot {
    /// Distance from the eye.
    t: f32,
    /// Where the material there was at rest, rest space.
    pos: vec3f,
    /// Continuity of the composed map; below 0 in a gap.
    continuity: f32,
    /// Templates that led here.
    path: u32,
    /// No triangle is nearer to `pos`, rest space.
    clearance: f32,
}

/// Where the march along a ray has got to.
struct MeshWalk {
    here: Spot,
    /// Templates that may reach the cell of `here`.
    mask: u32,
    /// The longest step that is tried next.
    step: f32,
    /// How much rest space a unit of the last step went through.
    stretch: f32,
    /// The triangle that `here` lies on, or NO_TRIANGLE.
    skipped: u32,
}

/// Something that a ray meets.
struct Met {
    /// False if the ray left the object.
    is_met: bool,
    /// Where: at rest, and on the ray.
    at: Spot,
    /// The triangle; NO_TRIANGLE for a cut face.
    triangle: u32,
    weights: vec3f,
    is_front: bool,
    /// The segment, from 1.
    segment: u32,
    /// Templates that may reach the place.
    mask: u32,
}

fn spot_at(ray: Ray, t: f32, mask: u32) -> Spot {
    let found = map_point(ray.origin + ray.dir * t, mask);
    return Spot(t, found.pos, found.continuity, found.path, clearance_at(found.pos));
}

fn unmoved_spot(ray: Ray, t: f32) -> Spot {
    return Spot(t, ray.origin + ray.dir * t, 1.0, 0u, 0.0);
}

/// The cell of the skip grid at a place of the ray. x: templates that may reach it; y: 0 if something may be seen
/// there; z: bits of the distance at which the ray leaves it, or the empty cells around it.
fn cell_on_ray(ray: Ray, t: f32) -> vec3u {
    if has_grid == 0u || grid.is_used == 0u {
        return vec3u(0xffffffffu, 0u, bitcast<u32>(ray.t_end));
    }
    let local = floor((ray.origin + ray.dir * t - grid.origin_min.xyz) / grid.cell_size.xyz);
    let cell = clamp(local, vec3f(0.0), vec3f(grid.cells.xyz) - 1.0);
    let content = textureLoad(grid_cells, vec3i(cell), 0).xy;
    let reach = max(f32(content.y), 1.0);
    let plane = select(cell + 1.0 - reach, cell + reach, ray.dir > vec3f(0.0));
    let exits = (grid.origin_min.xyz + plane * grid.cell_size.xyz - ray.origin) * ray.inverse_dir;
    let t_out = max(min(exits.x, min(exits.y, exits.z)), t) + 0.00002;
    return vec3u(content, bitcast<u32>(min(t_out, ray.t_end)));
}

/// The last place before something changes between two places of a ray, and the first behind it.
struct Edge {
    before: Spot,
    behind: Spot,
}

/// Finds where a gap begins or ends, or where the path changes, or, if neither does, where the map jumps.
fn edge_between(ray: Ray, here: Spot, next: Spot, mask: u32) -> Edge {
    var edge = Edge(here, next);
    let turns_gap = (here.continuity < 0.0) != (next.continuity < 0.0);
    let turns_path = here.path != next.path && !turns_gap;
    for (var turn = 0u; turn < MESH_BISECTIONS; turn++) {
        let middle = spot_at(ray, 0.5 * (edge.before.t + edge.behind.t), mask);
        var is_before = distance(middle.pos, edge.before.pos) <= distance(middle.pos, edge.behind.pos);
        if turns_gap {
            is_before = (middle.continuity < 0.0) == (here.continuity < 0.0);
        } else if turns_path {
            is_before = middle.path == here.path;
        }
        if is_before {
            edge.before = middle;
        } else {
            edge.behind = middle;
        }
    }
    return edge;
}

/// A crossing of a triangle between two places, made exact along the true curve: regula falsi on the triangle's plane.
fn exact_spot(ray: Ray, here: Spot, next: Spot, crossing: TriangleCrossing, mask: u32) -> Spot {
    let normal = face_of(crossing.triangle);
    let corner = corner_of(crossing.triangle, 0u);
    var low = vec2f(here.t, dot(here.pos - corner, normal));
    var high = vec2f(next.t, dot(next.pos - corner, normal));
    var spot = spot_at(ray, mix(here.t, next.t, crossing.part), mask);
    for (var turn = 0u; turn < 3u; turn++) {
        let height = dot(spot.pos - corner, normal);
        if (height < 0.0) == (low.y < 0.0) {
            low = vec2f(spot.t, height);
        } else {
            high = vec2f(spot.t, height);
        }
        let way = low.y - high.y;
        if abs(way) < 1e-9 {
            break;
        }
        spot = spot_at(ray, mix(low.x, high.x, clamp(low.y / way, 0.0, 1.0)), mask);
    }
    return spot;
}

fn met_triangle(at: Spot, crossing: TriangleCrossing, mask: u32) -> Met {
    let segment = segment_of(crossing.triangle) + 1u;
    return Met(true, at, crossing.triangle, crossing.weights, crossing.is_front, segment, mask);
}

/// What lies behind an edge: a cut face where the place behind is filled with a segment that did not fill the one
/// before; the surface of kept tissue, where the edge lies on a triangle.
fn met_at_edge(ray: Ray, edge: Edge, mask: u32) -> Met {
    let is_into_gap = edge.behind.continuity < 0.0;
    var at = edge.behind;
    if is_into_gap && KEEPS_TISSUE {
        at = edge.before;
    }
    var met = Met(false, at, NO_TRIANGLE, vec3f(0.0), true, 0u, mask);
    if at.continuity < 0.0 {
        return met;
    }
    let segment = filled_at(at.pos);
    let is_in_gap = min(edge.before.continuity, edge.behind.continuity) < 0.0;
    var before = 0u;
    // A gap around a hollow body that is kept ends at its triangles.
    if !is_in_gap || (KEEPS_TISSUE && segment == 0u) {
        before = select(filled_at(edge.before.pos), 0u, is_in_gap);
        let reach = ray.dir * LEAST_JUMP;
        let crossing = first_crossing(at.pos - reach, at.pos + reach, NO_TRIANGLE);
        if crossing.triangle != NO_TRIANGLE {
            return met_triangle(at, crossing, mask);
        }
    }
    met.is_met = !is_into_gap && segment != 0u && segment != before;
    met.segment = segment;
    return met;
}

/// The way to a place that no template reaches: one straight line as far as there is none.
fn cross_unmoved(ray: Ray, walk: ptr<function, MeshWalk>, first_exit: f32) -> Met {
    var t_out = first_exit;
    loop {
        let cell = cell_on_ray(ray, t_out);
        if t_out >= ray.t_end || (cell.x != 0u && drawn_kinds != 0u) {
            break;
        }
        t_out = max(bitcast<f32>(cell.z), t_out + 0.00002);
    }
    let start = ray.origin + ray.dir * (*walk).here.t;
    let end = ray.origin + ray.dir * t_out;
    let crossing = first_crossing(start, end, (*walk).skipped);
    let t = select(t_out, mix((*walk).here.t, t_out, crossing.part), crossing.triangle != NO_TRIANGLE);
    (*walk).here = unmoved_spot(ray, t);
    (*walk).skipped = crossing.triangle;
    var met = Met(false, (*walk).here, NO_TRIANGLE, vec3f(0.0), true, 0u, 0u);
    if crossing.triangle != NO_TRIANGLE {
        met = met_triangle((*walk).here, crossing, 0u);
    }
    return met;
}

/// Takes one step where templates act.
fn step_moved(ray: Ray, walk: ptr<function, MeshWalk>, mask: u32, t_out: f32) -> Met {
    let here = (*walk).here;
    let nothing = Met(false, here, NO_TRIANGLE, vec3f(0.0), true, 0u, mask);
    let is_gap = here.continuity < 0.0;
    let is_in_shell = mesh_look.has_shells != 0u && field_at(here.pos) > 0.0;
    let free = max(here.clearance, LONGEST_CHORD) / (1.25 * max((*walk).stretch, 0.25));
    let longest = select(LONGEST_STEP, SHELL_STEP, is_in_shell);
    let wanted = min((*walk).step, select(min(free, longest), GAP_STEP, is_gap));
    let t_next = min(here.t + max(wanted, SHORTEST_STEP), max(t_out, here.t + SHORTEST_STEP));
    let way = t_next - here.t;
    let next = spot_at(ray, t_next, mask);
    if is_gap && next.continuity < 0.0 {
        (*walk).here = next;
        (*walk).step = LONGEST_STEP;
        (*walk).stretch = 1.0;
        (*walk).skipped = NO_TRIANGLE;
        return nothing;
    }
    let turns = is_gap != (next.continuity < 0.0) || here.path != next.path;
    var edge = Edge(next, next);
    var has_edge = turns || distance(here.pos, next.pos) > MAX_STRETCH * way + LEAST_JUMP;
    if has_edge {
        edge = edge_between(ray, here, next, mask);
        has_edge = turns || distance(edge.before.pos, edge.behind.pos) > LEAST_JUMP;
    }
    if is_gap {
        (*walk).here = edge.behind;
        (*walk).step = LONGEST_STEP;
        return met_at_edge(ray, edge, mask);
    }
    let chord = distance(here.pos, edge.before.pos);
    if chord > 0.8 * (here.clearance + edge.before.clearance) {
        if chord > 1.5 * LONGEST_CHORD && way > 2.0 * SHORTEST_STEP {
            (*walk).step = 0.5 * way;
            return nothing;
        }
        let crossing = first_crossing(here.pos, edge.before.pos, (*walk).skipped);
        if crossing.triangle != NO_TRIANGLE {
            let at = exact_spot(ray, here, edge.before, crossing, mask);
            (*walk).here = at;
            (*walk).skipped = crossing.triangle;
            (*walk).step = LONGEST_STEP;
            return met_triangle(at, crossing, mask);
        }
    }
    (*walk).stretch = chord / max(edge.before.t - here.t, SHORTEST_STEP);
    (*walk).here = edge.behind;
    (*walk).step = 2.0 * way;
    (*walk).skipped = NO_TRIANGLE;
    if has_edge {
        (*walk).step = LONGEST_STEP;
        (*walk).stretch = 1.0;
        return met_at_edge(ray, edge, mask);
    }
    if is_in_shell {
        return inner_wall(ray, walk, here, edge.behind, mask);
    }
    return nothing;
}

/// The inner wall of a shell between two places inside of it.
fn inner_wall(ray: Ray, walk: ptr<function, MeshWalk>, here: Spot, next: Spot, mask: u32) -> Met {
    var met = Met(false, next, NO_TRIANGLE, vec3f(0.0), true, 0u, mask);
    let segment = filled_at(next.pos);
    if segment == 0u {
        return met;
    }
    if filled_at(here.pos) != 0u {
        return met;
    }
    // Where the depth is that of the wall: regula falsi, for each look at the triangles is dear.
    let thickness = mesh_look.segments[segment - 1u].thickness;
    var low = vec2f(here.t, max(nearest_inside(here.pos, segment - 1u).w - thickness, 1e-6));
    var high = vec2f(next.t, min(nearest_inside(next.pos, segment - 1u).w - thickness, -1e-6));
    var wall = next;
    for (var turn = 0u; turn < 3u; turn++) {
        let at = spot_at(ray, mix(low.x, high.x, low.y / (low.y - high.y)), mask);
        let above = nearest_inside(at.pos, segment - 1u).w - thickness;
        if above > 0.0 {
            low = vec2f(at.t, above);
        } else {
            high = vec2f(at.t, min(above, -1e-6));
        }
        wall = at;
    }
    met.is_met = true;
    met.at = wall;
    met.segment = segment;
    met.is_front = false;
    return met;
}

/// Marches to the next thing that the ray meets.
fn next_met(ray: Ray, walk: ptr<function, MeshWalk>, steps: ptr<function, u32>) -> Met {
    var met = Met(false, (*walk).here, NO_TRIANGLE, vec3f(0.0), true, 0u, 0u);
    while *steps < MAX_STEPS && (*walk).here.t < ray.t_end && !met.is_met {
        (*steps)++;
        let cell = cell_on_ray(ray, (*walk).here.t);
        let t_out = bitcast<f32>(cell.z);
        let is_moved = (cell.x != 0u && drawn_kinds != 0u) || mesh_look.has_shells != 0u;
        if cell.y != 0u && has_grid != 0u && grid.is_used != 0u {
            (*walk).here = unmoved_spot(ray, max(t_out, (*walk).here.t + 0.00002));
            (*walk).mask = 0u;
            (*walk).skipped = NO_TRIANGLE;
        } else if !is_moved {
            (*walk).mask = 0u;
            met = cross_unmoved(ray, walk, t_out);
        } else {
            if (*walk).mask == 0u && (*walk).skipped == NO_TRIANGLE {
                // From where no template acts.
                (*walk).here = spot_at(ray, (*walk).here.t, cell.x);
                (*walk).step = LONGEST_STEP;
                (*walk).stretch = 1.0;
            }
            let mask = cell.x | (*walk).mask;
            (*walk).mask = cell.x;
            met = step_moved(ray, walk, mask, t_out);
        }
    }
    return met;
}

/// How what is met looks: normal towards the eye in subject space, colour in linear light, opacity.
struct MetLook {
    normal: vec3f,
    /// Normal of the triangle's plane, towards the eye; of a cut face as `normal`.
    plane_normal: vec3f,
    albedo: vec3f,
    opacity: f32,
    gloss: f32,
}

/// Where the pixel lies on the triangle that is met. On a texture the place at rest says it, for `met.weights` are of a
/// chord.
fn footprint_of(ray: Ray, met: Met, jacobian: mat3x3f) -> Footprint {
    if has_textures == 0u {
        return place_alone(met.weights);
    }
    let a = corner_of(met.triangle, 0u);
    let b = corner_of(met.triangle, 1u);
    let c = corner_of(met.triangle, 2u);
    let weights = vec3f(1.0, 0.0, 0.0) + weights_along(a, b, c, met.at.pos - a);
    let next = next_pixels(ray, met.at.t);
    let next_at_rest = NextPixels(jacobian * next.right, jacobian * next.down);
    return footprint_on(a, b, c, weights, jacobian * ray.dir, next_at_rest);
}

fn look_of(ray: Ray, met: Met) -> MetLook {
    let edge = Sample(met.at.pos, 0.0, 1.0, met.at.continuity, met.at.path);
    let map = differential_at(ray.origin + ray.dir * met.at.t, ray.forward, edge, met.mask);
    let segment = met.segment - 1u;
    var look_here = MetLook(-ray.dir, -ray.dir, vec3f(0.0), 1.0, mesh_look.segments[segment].gloss);
    if met.triangle != NO_TRIANGLE {
        let face = carried_over(map.jacobian, face_of(met.triangle));
        let smooth_normal = carried_over(map.jacobian, normal_of_triangle(met.triangle, met.weights));
        look_here.normal = normal_to_eye(smooth_normal, face, ray.dir);
        look_here.plane_normal = normalize(select(face, -face, dot(face, ray.dir) > 0.0));
        if owner_of(met.triangle) >= LID {
            look_here.albedo = filling_color(met.segment, met.at.pos);
        } else {
            look_here.albedo = surface_color(met.triangle, footprint_of(ray, met, map.jacobian), met.is_front);
            look_here.opacity = opacity_of_triangle(met.triangle);
        }
    } else {
        let slope = length(map.slope);
        if !met.is_front {
            // The inner wall of a shell lies along the surface above it.
            let normal = normalize(carried_over(map.jacobian, nearest_inside(met.at.pos, segment).xyz) - ray.dir * 1e-6);
            look_here.normal = select(normal, -normal, dot(normal, ray.dir) >= 0.0);
        } else if slope > 1e-3 && slope < MAX_SLOPE && met.at.t > 0.0 {
            let normal = -map.slope / slope;
            look_here.normal = select(normal, -ray.dir, dot(normal, ray.dir) >= 0.0);
        }
        look_here.plane_normal = look_here.normal;
        look_here.albedo = filling_color(met.segment, met.at.pos);
    }
    let opacity = mesh_look.segments[segment].opacity;
    look_here.opacity = select(look_here.opacity, opacity, opacity >= 0.0);
    return look_here;
}

/// The cut face that a ray begins with: what fills the place of the eye.
fn met_at_start(ray: Ray) -> Met {
    var met = Met(false, unmoved_spot(ray, 0.0), NO_TRIANGLE, vec3f(0.0), true, 0u, 0xffffffffu);
    // A loop, which software rasterisers leave out where they would run a branch.
    for (var turn = ray.t_start; turn <= 0.0; turn = 1.0) {
        met.at = spot_at(ray, 0.0, 0xffffffffu);
        if met.at.continuity >= 0.0 {
            met.segment = filled_at(met.at.pos);
            met.is_met = met.segment != 0u;
        }
    }
    return met;
}

/// What a ray is said to meet.
fn event_of(met: Met, look_here: MetLook) -> Event {
    var what = MET_CUT;
    if met.triangle != NO_TRIANGLE && owner_of(met.triangle) < LID {
        what = select(MET_INSIDE, MET_SURFACE, met.is_front);
    }
    return Event(met.at.t, what, met.segment, look_here.plane_normal, met.at.pos, look_here.albedo);
}

/// How what is met is seen.
fn seen_of(ray: Ray, met: Met) -> Seen {
    let look_here = look_of(ray, met);
    let normal_in_view = apply_transposed(frame.subject_from_view, look_here.normal);
    let light = shade_surface(look_here.albedo, normal_in_view, -ray.dir_in_view, look_here.gloss);
    return Seen(event_of(met, look_here), look_here.normal, light, look_here.opacity, 0.0);
}
