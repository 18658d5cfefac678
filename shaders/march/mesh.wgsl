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
//   march/overrides.wgsl march/ghost.wgsl march/shade.wgsl march/sample.wgsl march/seek.wgsl march/jacobian.wgsl
//   march/surface.wgsl march/marched.wgsl march/gathered.wgsl march/textures.wgsl subject/mesh.wgsl
//   subject/crossing.wgsl march/filling.wgsl
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
    /// True until the place of the eye has been looked at: a ray that begins inside begins with a cut face.
    is_at_eye: bool,
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

// What a walk does next. Each of them asks the map once at most, and one place of the program asks it, as one place
// searches for triangles and one asks what fills a place: software GPUs compile each of these anew for every place.
/// Plans the next step.
const PLANS: u32 = 0u;
/// Asks for the place of the eye.
const STARTS: u32 = 1u;
/// Asks for the place of the walk, where it comes from places that no template reaches.
const ENTERS: u32 = 2u;
/// Asks for the end of a step.
const STEPS: u32 = 3u;
/// Asks for the middle of a way on which something changes.
const HALVES: u32 = 4u;
/// Asks for a guess of where the ray crosses a triangle, or the inner wall of a shell.
const GUESSES: u32 = 5u;
/// Has come to the end of a step. This and those below ask the map nothing.
const ARRIVES: u32 = 6u;
/// Goes straight on through places that no template reaches.
const CROSSES: u32 = 7u;
/// Looks at what lies behind an edge.
const FACES: u32 = 8u;
/// Looks for the inner wall of a shell on a step.
const SINKS: u32 = 9u;
/// Looks whether a shell is there where the ray goes in through its lid.
const RIMS: u32 = 10u;

/// The last place before something changes between two places of a ray, and the first behind it.
struct Edge {
    before: Spot,
    behind: Spot,
}

/// What a walk is about, between one step and the next.
struct Errand {
    /// One of the constants above.
    task: u32,
    /// Where the map is asked, distance from the eye.
    t: f32,
    /// By which templates.
    mask: u32,
    /// True after `ENTERS`, until the step from there is planned.
    has_entered: bool,
    /// How often the task has been done.
    turn: u32,
    /// Length of the step, and whether it began inside a shell.
    way: f32,
    is_in_shell: bool,
    /// The edge on the step, or twice its end if it has none.
    edge: Edge,
    has_edge: bool,
    /// The crossing that is made exact; of the wall of a shell NO_TRIANGLE, and the segment from 1.
    crossing: TriangleCrossing,
    segment: u32,
    /// Two places of the ray on both sides of it (distance from the eye), and their heights above it.
    low: vec2f,
    high: vec2f,
}

fn met_nothing(at: Spot, mask: u32) -> Met {
    return Met(false, at, NO_TRIANGLE, vec3f(0.0), true, 0u, mask);
}

fn met_triangle(at: Spot, crossing: TriangleCrossing, mask: u32) -> Met {
    let segment = segment_of(crossing.triangle) + 1u;
    return Met(true, at, crossing.triangle, crossing.weights, crossing.is_front, segment, mask);
}

/// Where a straight way ends that begins in a cell which no template reaches: as far as there is none, and no empty
/// cell. A short way meets few boxes of the tree, and most rays end in the first cells that hold something.
fn end_of_unmoved(ray: Ray, first_exit: f32) -> f32 {
    var t_out = first_exit;
    loop {
        let cell = cell_on_ray(ray, t_out);
        if t_out >= ray.t_end || cell.y != 0u || (cell.x != 0u && drawn_kinds != 0u) {
            break;
        }
        t_out = max(bitcast<f32>(cell.z), t_out + 0.00002);
    }
    return t_out;
}

/// Plans what comes next at the place of the walk.
fn plan(ray: Ray, walk: ptr<function, MeshWalk>, errand: ptr<function, Errand>) {
    let here = (*walk).here;
    let cell = cell_on_ray(ray, here.t);
    let t_out = bitcast<f32>(cell.z);
    let is_moved = (cell.x != 0u && drawn_kinds != 0u) || has_shells != 0u;
    if cell.y != 0u && has_grid != 0u && grid.is_used != 0u {
        (*walk).here = unmoved_spot(ray, max(t_out, here.t + 0.00002));
        (*walk).mask = 0u;
        (*walk).skipped = NO_TRIANGLE;
    } else if !is_moved {
        (*walk).mask = 0u;
        (*errand).task = CROSSES;
        (*errand).t = end_of_unmoved(ray, t_out);
    } else if (*walk).mask == 0u && (*walk).skipped == NO_TRIANGLE && !(*errand).has_entered {
        (*errand).task = ENTERS;
        (*errand).t = here.t;
        (*errand).mask = cell.x;
    } else {
        let is_in_shell = has_shells != 0u && field_at(here.pos) > 0.0;
        let free = max(here.clearance, LONGEST_CHORD) / (1.25 * max((*walk).stretch, 0.25));
        let longest = select(LONGEST_STEP, SHELL_STEP, is_in_shell);
        let wanted = min((*walk).step, select(min(free, longest), GAP_STEP, here.continuity < 0.0));
        (*errand).task = STEPS;
        (*errand).t = min(here.t + max(wanted, SHORTEST_STEP), max(t_out, here.t + SHORTEST_STEP));
        (*errand).mask = cell.x | (*walk).mask;
        (*errand).way = (*errand).t - here.t;
        (*errand).is_in_shell = is_in_shell;
        (*errand).has_entered = false;
        (*walk).mask = cell.x;
    }
}

/// The end of a step is known.
fn take_step(walk: ptr<function, MeshWalk>, errand: ptr<function, Errand>, next: Spot) {
    let here = (*walk).here;
    let is_gap = here.continuity < 0.0;
    if is_gap && next.continuity < 0.0 {
        (*walk).here = next;
        (*walk).step = LONGEST_STEP;
        (*walk).stretch = 1.0;
        (*walk).skipped = NO_TRIANGLE;
        (*errand).task = PLANS;
        return;
    }
    let turns = is_gap != (next.continuity < 0.0) || here.path != next.path;
    (*errand).has_edge = turns || distance(here.pos, next.pos) > MAX_STRETCH * (*errand).way + LEAST_JUMP;
    (*errand).task = select(ARRIVES, HALVES, (*errand).has_edge);
    (*errand).edge = Edge(next, next);
    if (*errand).has_edge {
        (*errand).edge.before = here;
        (*errand).t = 0.5 * (here.t + next.t);
        (*errand).turn = 0u;
    }
}

/// Halves the way on which a gap begins or ends, or the path changes, or, if neither does, the map jumps.
fn halve(walk: ptr<function, MeshWalk>, errand: ptr<function, Errand>, middle: Spot) {
    let here = (*walk).here;
    let edge = (*errand).edge;
    let is_gap = here.continuity < 0.0;
    let turns_gap = is_gap != (edge.behind.continuity < 0.0);
    let turns_path = here.path != edge.behind.path && !turns_gap;
    var is_before = distance(middle.pos, edge.before.pos) <= distance(middle.pos, edge.behind.pos);
    if turns_gap {
        is_before = (middle.continuity < 0.0) == is_gap;
    } else if turns_path {
        is_before = middle.path == here.path;
    }
    if is_before {
        (*errand).edge.before = middle;
    } else {
        (*errand).edge.behind = middle;
    }
    (*errand).t = 0.5 * ((*errand).edge.before.t + (*errand).edge.behind.t);
    (*errand).turn++;
    if (*errand).turn == MESH_BISECTIONS {
        let jump = distance((*errand).edge.before.pos, (*errand).edge.behind.pos);
        (*errand).has_edge = turns_gap || turns_path || jump > LEAST_JUMP;
        (*errand).task = ARRIVES;
    }
}

/// Height of a place above what is made exact: a triangle's plane, or the inner wall of a shell.
fn height_above(errand: ptr<function, Errand>, pos: vec3f) -> f32 {
    let triangle = (*errand).crossing.triangle;
    var height = 0.0;
    var is_wall = triangle == NO_TRIANGLE;
    while is_wall {
        is_wall = false;
        let segment = (*errand).segment - 1u;
        height = nearest_inside(pos, segment).w - mesh_look.segments[segment].thickness;
    }
    if triangle != NO_TRIANGLE {
        height = dot(pos - corner_of(triangle, 0u), face_of(triangle));
    }
    return height;
}

/// Takes a guess of where the ray crosses, along the true curve, and makes the next one: regula falsi. Returns what is
/// met after the last one.
fn take_guess(walk: ptr<function, MeshWalk>, errand: ptr<function, Errand>, spot: Spot) -> Met {
    let crossing = (*errand).crossing;
    let is_wall = crossing.triangle == NO_TRIANGLE;
    var height = height_above(errand, spot.pos);
    var is_low = (height < 0.0) == ((*errand).low.y < 0.0);
    let turn = (*errand).turn;
    let measures = is_wall && turn < 2u;
    if measures {
        // Both ends of the way to a wall are measured first, the far one before the near one.
        is_low = turn == 1u;
        height = select(min(height, -1e-6), max(height, 1e-6), is_low);
    }
    if is_low {
        (*errand).low = vec2f(spot.t, height);
    } else {
        (*errand).high = vec2f(spot.t, height);
    }
    let fall = (*errand).low.y - (*errand).high.y;
    let guess = clamp((*errand).low.y / select(fall, 1.0, fall == 0.0), 0.0, 1.0);
    let part = select(guess, 0.0, is_wall && turn == 0u);
    (*errand).t = mix((*errand).low.x, (*errand).high.x, part);
    (*errand).turn++;
    var met = met_nothing(spot, (*errand).mask);
    if turn == select(3u, 4u, is_wall) || (abs(fall) < 1e-9 && !measures) {
        (*errand).task = PLANS;
        if is_wall {
            met = Met(true, spot, NO_TRIANGLE, vec3f(0.0), false, (*errand).segment, (*errand).mask);
        } else {
            met = met_triangle(spot, crossing, (*errand).mask);
            (*walk).here = spot;
            (*walk).skipped = crossing.triangle;
            (*walk).step = LONGEST_STEP;
        }
    }
    return met;
}

/// Takes what the map said of the place that was asked.
fn take_spot(walk: ptr<function, MeshWalk>, errand: ptr<function, Errand>, spot: Spot) -> Met {
    var met = met_nothing(spot, (*errand).mask);
    let task = (*errand).task;
    if task == STEPS {
        take_step(walk, errand, spot);
    } else if task == HALVES {
        halve(walk, errand, spot);
    } else if task == GUESSES {
        met = take_guess(walk, errand, spot);
    } else if task == ENTERS {
        (*walk).here = spot;
        (*walk).step = LONGEST_STEP;
        (*walk).stretch = 1.0;
        (*errand).has_entered = true;
        (*errand).task = PLANS;
    } else {
        (*errand).edge = Edge(spot, spot);
    }
    return met;
}

/// What an errand asks the bodies and their triangles.
struct Question {
    /// How many places are asked for what fills them: of the edge's two the one behind, then the one before.
    fills: u32,
    /// The place behind, or, where kept tissue ends there, the one before.
    at: Spot,
    /// True if a line is searched for triangles, from where to where, and without which.
    searches: bool,
    start: vec3f,
    end: vec3f,
    skipped: u32,
}

/// What is asked where no template moves anything, at the end of a step, behind an edge, in a shell and at the eye.
fn question_of(ray: Ray, walk: ptr<function, MeshWalk>, errand: ptr<function, Errand>) -> Question {
    let here = (*walk).here;
    let edge = (*errand).edge;
    var asked = Question(0u, edge.behind, false, vec3f(0.0), vec3f(0.0), (*walk).skipped);
    if (*errand).task == ARRIVES {
        let chord = distance(here.pos, edge.before.pos);
        let is_near = chord > 0.8 * (here.clearance + edge.before.clearance);
        if here.continuity < 0.0 {
            (*walk).here = edge.behind;
            (*walk).step = LONGEST_STEP;
            (*errand).task = FACES;
        } else if is_near && chord > 1.5 * LONGEST_CHORD && (*errand).way > 2.0 * SHORTEST_STEP {
            (*walk).step = 0.5 * (*errand).way;
            (*errand).task = PLANS;
        } else {
            asked.searches = is_near;
            asked.start = here.pos;
            asked.end = edge.before.pos;
        }
    }
    let task = (*errand).task;
    if task == CROSSES {
        asked.searches = true;
        asked.start = ray.origin + ray.dir * here.t;
        asked.end = ray.origin + ray.dir * (*errand).t;
    } else if task == FACES || task == STARTS {
        if KEEPS_TISSUE && edge.behind.continuity < 0.0 {
            asked.at = edge.before;
        }
        let is_alone = task == STARTS || min(edge.before.continuity, edge.behind.continuity) < 0.0;
        asked.fills = select(select(2u, 1u, is_alone), 0u, asked.at.continuity < 0.0);
    } else if task == SINKS {
        asked.fills = 2u;
    } else if task == RIMS {
        asked.fills = 1u;
    }
    return asked;
}

/// Segments, from 1, that fill the places that are asked, `at` first; 0 where there is none.
fn fillings_of(asked: Question, errand: ptr<function, Errand>) -> vec2u {
    var filled = vec2u(0u);
    for (var k = 0u; k < asked.fills; k++) {
        let segment = filled_at(select(asked.at.pos, (*errand).edge.before.pos, k == 1u));
        filled = select(filled, vec2u(segment), vec2u(0u, 1u) == vec2u(k));
        if (*errand).task == SINKS && segment == 0u {
            break;
        }
    }
    return filled;
}

/// Draws the conclusion of an errand that asks the map nothing. Returns what is met there.
fn conclude(ray: Ray, walk: ptr<function, MeshWalk>, errand: ptr<function, Errand>, at: Spot, filled: vec2u, crossing: TriangleCrossing) -> Met {
    let mask = (*errand).mask;
    let here = (*walk).here;
    let edge = (*errand).edge;
    let task = (*errand).task;
    let is_crossed = crossing.triangle != NO_TRIANGLE;
    var met = met_nothing(at, mask);
    (*errand).task = PLANS;
    if task == CROSSES {
        let t = select((*errand).t, mix(here.t, (*errand).t, crossing.part), is_crossed);
        (*walk).here = unmoved_spot(ray, t);
        (*walk).skipped = crossing.triangle;
        if is_crossed {
            met = met_triangle((*walk).here, crossing, 0u);
        }
    } else if task == ARRIVES && is_crossed {
        let normal = face_of(crossing.triangle);
        let corner = corner_of(crossing.triangle, 0u);
        (*errand).crossing = crossing;
        (*errand).low = vec2f(here.t, dot(here.pos - corner, normal));
        (*errand).high = vec2f(edge.before.t, dot(edge.before.pos - corner, normal));
        (*errand).t = mix(here.t, edge.before.t, crossing.part);
        (*errand).turn = 0u;
        (*errand).task = GUESSES;
    } else if task == ARRIVES {
        let chord = distance(here.pos, edge.before.pos);
        (*walk).stretch = select(chord / max(edge.before.t - here.t, SHORTEST_STEP), 1.0, (*errand).has_edge);
        (*walk).step = select(2.0 * (*errand).way, LONGEST_STEP, (*errand).has_edge);
        (*walk).here = edge.behind;
        (*walk).skipped = NO_TRIANGLE;
        if (*errand).has_edge {
            (*errand).task = FACES;
        } else if (*errand).is_in_shell {
            (*errand).edge.before = here;
            (*errand).task = SINKS;
        }
    } else if task == SINKS {
        if filled.x != 0u && filled.y == 0u {
            (*errand).crossing.triangle = NO_TRIANGLE;
            (*errand).segment = filled.x;
            (*errand).low = vec2f(edge.before.t, 0.0);
            (*errand).t = edge.behind.t;
            (*errand).turn = 0u;
            (*errand).task = GUESSES;
        }
    } else if is_crossed {
        met = met_triangle(at, crossing, mask);
    } else if at.continuity >= 0.0 {
        // A cut face, where the place is filled with a segment that does not fill the one before.
        met.is_met = edge.behind.continuity >= 0.0 && filled.x != 0u && filled.x != filled.y;
        met.segment = filled.x;
    }
    return met;
}

/// True for the triangles of a lid of a shell.
fn is_lid_of_shell(triangle: u32) -> bool {
    if triangle == NO_TRIANGLE {
        return false;
    }
    let owner = owner_of(triangle);
    return owner >= LID && mesh_look.segments[owner & ~LID].kind == BODY_THICK;
}

/// True if rays may be bent, or meet the rims of shells: `next_met` has errands then.
fn has_errands() -> bool {
    return drawn_kinds != 0u || has_shells != 0u;
}

/// Goes straight on, from empty cells to cells that hold something, to the next triangle or as far as no template
/// reaches. All of it can be done by errands, with much more ado: most rays begin so, and many end so.
fn next_straight(ray: Ray, walk: ptr<function, MeshWalk>, steps: ptr<function, u32>) -> Met {
    var met = met_nothing((*walk).here, 0u);
    let is_at_eye = (*walk).is_at_eye && ray.t_start <= 0.0;
    var is_straight = (*walk).mask == 0u && has_shells == 0u && !(is_at_eye && has_errands());
    var starts = is_at_eye && !has_errands();
    while starts {
        starts = false;
        met.segment = filled_at((*walk).here.pos);
        met.is_met = met.segment != 0u;
        is_straight = !met.is_met;
    }
    while is_straight {
        let t = (*walk).here.t;
        let cell = cell_on_ray(ray, t);
        let is_empty = cell.y != 0u;
        is_straight = t < ray.t_end && *steps < MAX_STEPS && (is_empty || cell.x == 0u || drawn_kinds == 0u);
        if is_straight {
            (*steps)++;
        }
        var t_next = max(bitcast<f32>(cell.z), t + 0.00002);
        var crossing = TriangleCrossing(NO_TRIANGLE, 1.0, vec3f(0.0), false);
        var searches = is_straight && !is_empty;
        while searches {
            searches = false;
            t_next = end_of_unmoved(ray, bitcast<f32>(cell.z));
            let start = ray.origin + ray.dir * t;
            crossing = first_crossing(start, ray.origin + ray.dir * t_next, (*walk).skipped, true);
        }
        if is_straight {
            let is_crossed = crossing.triangle != NO_TRIANGLE;
            (*walk).here = unmoved_spot(ray, select(t_next, mix(t, t_next, crossing.part), is_crossed));
            (*walk).skipped = crossing.triangle;
            if is_crossed {
                met = met_triangle((*walk).here, crossing, 0u);
                is_straight = false;
            }
        }
    }
    return met;
}

/// Marches to the next thing that the ray meets.
fn next_met(ray: Ray, walk: ptr<function, MeshWalk>, steps: ptr<function, u32>) -> Met {
    var met = next_straight(ray, walk, steps);
    var errand: Errand;
    errand.task = select(PLANS, STARTS, (*walk).is_at_eye && ray.t_start <= 0.0);
    errand.mask = 0xffffffffu;
    (*walk).is_at_eye = false;
    // A lid of a shell that is crossed: if the shell is there, its rim is met.
    var rim = met;
    while has_errands() && !met.is_met {
        let is_at_rim = errand.task == RIMS;
        if errand.task == PLANS {
            if *steps >= MAX_STEPS || (*walk).here.t >= ray.t_end {
                break;
            }
            (*steps)++;
            plan(ray, walk, &errand);
        }
        // Loops, which software rasterisers leave out where they would run a branch.
        var asks = errand.task != PLANS && errand.task < ARRIVES;
        while asks {
            asks = false;
            met = take_spot(walk, &errand, spot_at(ray, errand.t, errand.mask));
        }
        if errand.task == STARTS || errand.task >= ARRIVES {
            var asked = question_of(ray, walk, &errand);
            let filled = fillings_of(asked, &errand);
            if errand.task == FACES && asked.at.continuity >= 0.0 {
                // Kept tissue ends at its triangles: so does a gap around a hollow body that is kept.
                asked.searches = asked.fills == 2u || (KEEPS_TISSUE && filled.x == 0u);
                asked.start = asked.at.pos - ray.dir * LEAST_JUMP;
                asked.end = asked.at.pos + ray.dir * LEAST_JUMP;
                asked.skipped = NO_TRIANGLE;
            }
            var crossing = TriangleCrossing(NO_TRIANGLE, 1.0, vec3f(0.0), false);
            while asked.searches {
                asked.searches = false;
                crossing = first_crossing(asked.start, asked.end, asked.skipped, true);
            }
            if errand.task != PLANS {
                met = conclude(ray, walk, &errand, asked.at, filled, crossing);
            }
            if is_at_rim {
                met = rim;
                met.is_met = filled.x == rim.segment;
            }
        }
        if met.is_met && !is_at_rim && is_lid_of_shell(met.triangle) {
            rim = met;
            met.is_met = false;
            errand.task = select(PLANS, RIMS, rim.is_front);
            errand.edge.behind = rim.at;
            errand.edge.behind.pos -= LEAST_JUMP * face_of(rim.triangle);
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
    if has_textures == 0u && has_wires == 0u {
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
    let is_cut = met.triangle == NO_TRIANGLE;
    let is_wall = is_cut && !met.is_front;
    let shows_filling = is_cut || owner_of(met.triangle) >= LID;
    var nearest = vec4f(0.0);
    var asks = select(0u, 1u, is_wall || (shows_filling && mesh_look.segments[segment].layer_count > 0u));
    while asks > 0u {
        asks--;
        nearest = nearest_inside(met.at.pos, segment);
    }
    var look_here = MetLook(-ray.dir, -ray.dir, vec3f(0.0), 1.0, mesh_look.segments[segment].gloss);
    if is_cut {
        let slope = length(map.slope);
        if is_wall {
            // The inner wall of a shell lies along the surface above it.
            let normal = normalize(carried_over(map.jacobian, nearest.xyz) - ray.dir * 1e-6);
            look_here.normal = select(normal, -normal, dot(normal, ray.dir) >= 0.0);
        } else if slope > 1e-3 && slope < MAX_SLOPE && met.at.t > 0.0 {
            let normal = -map.slope / slope;
            look_here.normal = select(normal, -ray.dir, dot(normal, ray.dir) >= 0.0);
        }
        look_here.plane_normal = look_here.normal;
    } else {
        let face = carried_over(map.jacobian, face_of(met.triangle));
        let smooth_normal = carried_over(map.jacobian, normal_of_triangle(met.triangle, met.weights));
        look_here.normal = normal_to_eye(smooth_normal, face, ray.dir);
        look_here.plane_normal = normalize(select(face, -face, dot(face, ray.dir) > 0.0));
    }
    if shows_filling {
        look_here.albedo = filling_color(met.segment, met.at.pos, nearest.w);
    } else {
        let at = footprint_of(ray, met, map.jacobian);
        look_here.albedo = surface_color(met.triangle, at, met.is_front);
        if has_wires != 0u {
            look_here.albedo = wired(look_here.albedo, at);
        }
        look_here.opacity = opacity_of_triangle(met.triangle);
    }
    let opacity = mesh_look.segments[segment].opacity;
    look_here.opacity = select(look_here.opacity, opacity, opacity >= 0.0);
    return look_here;
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
    var opacity = look_here.opacity;
    if has_ghost != 0u {
        opacity *= ghost_keeps(1.0, look_here.normal, -ray.dir);
    }
    return Seen(event_of(met, look_here), look_here.normal, light, opacity, 0.0);
}
