// Sweep: tools that move through the tissue and take with them what is near. Metric template space, from the middle of
// the box; defined everywhere.
// Source: Angelidis, Wyvill and Cani, Sweepers, sections 3 and 4; spec/sweepers.md, A.
//
//        tool at progress 0                the tissue in the coating follows in part: velocity = field · velocity of
//     ___ .....                            the tool; all of it inside the tool follows whole
//    (   ).    .
//     ---  \   .  coating                  source: the flow run backwards, from progress to 0
//           \ ___
//            (   ) progress
//             ---
//
// Differs from the source: not its sub-steps, in which the field stands still, but their limit, the flow of the
// weighted velocities, so that the result depends on no number of steps, part of the way and the rest are the whole,
// and there is an inverse: the same flow backwards (spec/sweepers.md, D, has all of it).
//
// By classical Runge-Kutta, whose steps the processor finds (src/displace/sweeping.rs), for each cluster of tools and
// images whose reaches meet: what another moves is out of their reach. Clusters that are mirror images of each other
// are copies of one. `templates.pool[held]` (src/displace/sweep_rows.rs) holds the number of copies of clusters, the
// progress that all act until, bits of the axes that are mirrored; then the box outside which nothing moves; then five
// rows for each copy. Those are: where steps, blocks of steps and blocks of those begin in the texture of sweeps, and
// the number of tools; the last step that acts, the number of images, and the row from `held` on where these begin; the
// signs of the axes by which it is mirrored; the box outside which it moves nothing. Then come, for each cluster, the
// signs of the axes and the tool (w) of each image, and for each tool two rows: its form; its shape and what one
// through its coating is.
// A step in the texture: its start and length, and how many steps before it are as long and go by the same screw; a
// ball that holds the reach of all that moves in it (w: square of the radius); for each tool a ball that holds its
// reach, rows of the inverse of its pose at the start, its screw (turn and growth, velocity of the origin), its scale.
// The screw of a tool alone is that of its own place at the start.
//
// One processor that draws in our tests (lavapipe) ends all loops of a pixel after 65,535 turns in all. So one turn of
// a loop passes over 64 steps whose reach does not hold the point, or 8, and evaluates one field in those that do, or
// four where tools are many. A loop in a branch that is not taken costs a turn there too: a field has none.
// needs: bind/templates.wgsl displace/frame.wgsl displace/tools.wgsl

/// Steps in a block, and blocks in a block of blocks, as a power of two.
const SWEEP_BLOCK_BITS: u32 = 3u;
/// Rows of the pool before those of copies, and for each of these.
const SWEEP_HEAD: u32 = 3u;
const SWEEP_COPY_ROWS: u32 = 5u;
/// Texels of a step for itself.
const SWEEP_STEP_ROWS: u32 = 2u;
/// Texels of a step for each tool.
const SWEEP_TOOL_ROWS: u32 = 6u;

/// Bit j is set if image j of a tool may reach a point. `first`: the ball of the first tool; `of_images`: the first row
/// of the images in the pool.
fn sweep_hits(x: vec3f, first: u32, of_images: u32, images: u32) -> u32 {
    var hits = 0u;
    for (var j = 0u; j < images; j += 2u) {
        // Two to a turn; the second is the first again where there is none.
        let k = min(j + 1u, images - 1u);
        let one = templates.pool[of_images + j];
        let two = templates.pool[of_images + k];
        let ball_one = sweep_texel(first + SWEEP_TOOL_ROWS * u32(one.w));
        let ball_two = sweep_texel(first + SWEEP_TOOL_ROWS * u32(two.w));
        let way_one = one.xyz * x - ball_one.xyz;
        let way_two = two.xyz * x - ball_two.xyz;
        hits |= select(0u, 1u << j, dot(way_one, way_one) <= ball_one.w);
        hits |= select(0u, 1u << k, dot(way_two, way_two) <= ball_two.w);
    }
    return hits;
}

/// A step that may move a point, -1 for none, and the block and the block of blocks that hold it.
struct FoundStep {
    index: i32,
    known: vec2i,
}

/// The last step from `last` on backwards that may move a point. `before_known`: block and block of blocks whose steps
/// are asked for themselves; -1 for none.
fn sweep_find(x: vec3f, last: i32, head: vec4f, before_known: vec2i) -> FoundStep {
    let step_rows = SWEEP_STEP_ROWS + SWEEP_TOOL_ROWS * u32(head.w);
    var i = last;
    var known = before_known;
    while i >= 0 {
        let block = vec2i(i, i >> SWEEP_BLOCK_BITS) >> vec2u(SWEEP_BLOCK_BITS);
        let is_wide = known.y != block.y;
        let is_block = !is_wide && known.x != block.x;
        var ball = u32(head.x) + u32(i) * step_rows + 1u;
        var before = i - 1;
        if is_wide {
            ball = u32(head.z) + u32(block.y);
            before = (block.y << (2u * SWEEP_BLOCK_BITS)) - 1;
        } else if is_block {
            ball = u32(head.y) + u32(block.x);
            before = (block.x << SWEEP_BLOCK_BITS) - 1;
        }
        let reach = sweep_texel(ball);
        let way = x - reach.xyz;
        if dot(way, way) > reach.w {
            i = before;
        } else if is_wide {
            known.y = block.y;
        } else if is_block {
            known.x = block.x;
        } else {
            break;
        }
    }
    return FoundStep(i, known);
}

/// The last step that begins before a time.
fn sweep_step_at(time: f32, last: u32, head: vec4f) -> u32 {
    let step_rows = SWEEP_STEP_ROWS + SWEEP_TOOL_ROWS * u32(head.w);
    var low = 0u;
    var high = last;
    while low < high {
        let middle = (low + high + 1u) / 2u;
        if sweep_texel(u32(head.x) + middle * step_rows).x < time {
            low = middle;
        } else {
            high = middle - 1u;
        }
    }
    return low;
}

/// Velocity of what goes with a screw, at a way from its origin, without that of the origin.
fn screw_linear(v: vec3f, screw: vec4f) -> vec3f {
    return screw.w * v + cross(screw.xyz, v);
}

/// A point as a tool has it within a step.
struct Posed {
    /// Velocity of what goes with the tool at the point.
    velocity: vec3f,
    /// Where the point lay to the tool as the point lies to it now, when the step began.
    place: vec3f,
    /// How much larger the tool is than at the start of the step.
    growth: f32,
}

/// A point as a tool has it, so long after the start of a step. `screw` and `moves`: rows of the tool in the step.
fn posed_in_step(p: vec3f, since: f32, screw: vec4f, moves: vec4f) -> Posed {
    let velocity = screw_linear(p, screw) + moves.xyz;
    // exp(-since L) p and e^(growth since) by their series: a step is short.
    let back = -since;
    let third = velocity + back / 4.0 * screw_linear(velocity, screw);
    let second = velocity + back / 3.0 * screw_linear(third, screw);
    let then = p + back * (velocity + back / 2.0 * screw_linear(second, screw));
    let grown = screw.w * since;
    let growth = 1.0 + grown * (1.0 + grown / 2.0 * (1.0 + grown / 3.0 * (1.0 + grown / 4.0)));
    return Posed(velocity, then, growth);
}

/// The integration of the flow through one step, between two of its fields.
struct Flow {
    /// Where the stage asks, and how long after the step's start.
    x: vec3f,
    since: f32,
    /// The velocities of the stages so far, with their weights.
    total: vec3f,
    /// Stage of Runge-Kutta's method: 4 at the end.
    stage: u32,
    /// Of the images so far: the sum of fields times velocities, the sum of fields, the product of what is left.
    driven: vec3f,
    fields: f32,
    left: f32,
    /// Images whose fields the stage still asks for.
    ahead: u32,
    /// Of a curve, the distance to its pieces so far.
    nearest: f32,
    piece: u32,
}

/// What stays the same through a step.
struct SweepStep {
    end: vec3f,
    lasts: f32,
    /// The axes whose mirror plane holds the point: it stays in the plane, to the bit.
    stays: vec3<bool>,
    /// The images that may reach the point.
    near: u32,
    /// Rows of the images and of the tools in the pool, texel of the step.
    of_images: u32,
    of_tools: u32,
    at: u32,
}

/// The flow with one field more, or with some pieces of a curve; as it is at the end of the step.
fn with_field(flow: Flow, step: SweepStep) -> Flow {
    let of_image = templates.pool[step.of_images + firstTrailingBit(flow.ahead)];
    let tool = u32(of_image.w);
    let first = step.at + SWEEP_STEP_ROWS + SWEEP_TOOL_ROWS * tool;
    let form = templates.pool[step.of_tools + 2u * tool];
    let kind = templates.pool[step.of_tools + 2u * tool + 1u];
    let screw = sweep_texel(first + 4u);
    let moves = sweep_texel(first + 5u);
    let posed = posed_in_step(of_image.xyz * flow.x, flow.since, screw, moves);
    let own = vec4f(posed.place, 1.0);
    let place = vec3f(
        dot(sweep_texel(first + 1u), own),
        dot(sweep_texel(first + 2u), own),
        dot(sweep_texel(first + 3u), own),
    );
    let shape = u32(kind.x);
    var next = flow;
    var distance = tool_distance(place, shape, form);
    var is_whole = true;
    if shape == CURVE_SHAPE {
        let begin = u32(form.y);
        let last = begin + u32(form.z) - 1u;
        let nearest = min(flow.nearest, pieces_distance(place, begin + flow.piece, last));
        is_whole = begin + flow.piece + CURVE_PIECES >= last;
        distance = max(nearest - form.x, 0.0);
        next.nearest = select(nearest, NO_END, is_whole);
        next.piece = select(flow.piece + CURVE_PIECES, 0u, is_whole);
    }
    let field = select(0.0, tool_field(moves.w * posed.growth * distance * kind.y), is_whole);
    next.fields += field;
    next.left *= 1.0 - field;
    next.driven += field * (of_image.xyz * posed.velocity);
    next.ahead &= select(flow.ahead, flow.ahead - 1u, is_whole);
    if next.ahead == 0u {
        let velocity = select(next.driven * ((1.0 - next.left) / max(next.fields, 1e-30)), vec3f(0.0), step.stays);
        let is_middle = flow.stage == 1u || flow.stage == 2u;
        // A turn may go on beyond the last stage.
        next.total += select(select(1.0, 2.0, is_middle), 0.0, flow.stage >= 4u) * velocity;
        let way = select(0.5, 1.0, flow.stage == 2u) * step.lasts;
        next.x = step.end - way * velocity;
        next.since = step.lasts - way;
        next.stage++;
        next.ahead = step.near;
        next.fields = 0.0;
        next.left = 1.0;
        next.driven = vec3f(0.0);
    }
    return next;
}

/// The flow with three fields more, where loops would take too many turns: all fields of a step of tools that are no
/// curves are a multiple of four.
fn with_three_fields(flow: Flow, step: SweepStep) -> Flow {
    return with_field(with_field(with_field(flow, step), step), step);
}

/// As `sweep_back`, six times over `lasts`, where one image alone may reach the point, whose tool is no curve: what is
/// read of it serves all stages.
fn sweep_back_one(step: SweepStep) -> vec3f {
    let of_image = templates.pool[step.of_images + firstTrailingBit(step.near)];
    let tool = u32(of_image.w);
    let first = step.at + SWEEP_STEP_ROWS + SWEEP_TOOL_ROWS * tool;
    let form = templates.pool[step.of_tools + 2u * tool];
    let kind = templates.pool[step.of_tools + 2u * tool + 1u];
    let row_x = sweep_texel(first + 1u);
    let row_y = sweep_texel(first + 2u);
    let row_z = sweep_texel(first + 3u);
    let screw = sweep_texel(first + 4u);
    let moves = sweep_texel(first + 5u);
    let end = of_image.xyz * step.end;
    var at = end;
    var since = step.lasts;
    var total = vec3f(0.0);
    // A loop: drawn out it is no quicker, and takes twice as long to compile.
    for (var stage = 0u; stage < 4u; stage++) {
        let posed = posed_in_step(at, since, screw, moves);
        let own = vec4f(posed.place, 1.0);
        let place = vec3f(dot(row_x, own), dot(row_y, own), dot(row_z, own));
        let distance = moves.w * posed.growth * tool_distance(place, u32(kind.x), form);
        let flow = tool_field(distance * kind.y) * posed.velocity;
        total += select(1.0, 2.0, stage == 1u || stage == 2u) * flow;
        let next = select(0.5, 1.0, stage == 2u) * step.lasts;
        at = end - next * flow;
        since = step.lasts - next;
    }
    return of_image.xyz * total;
}

/// From where the flow of one step has brought a point, from `lasts` after the step's start. `at`: texel of the step.
fn sweep_back(end: vec3f, at: u32, lasts: f32, of_images: u32, images: u32, mirror: u32) -> vec3f {
    let planes = (vec3u(mirror) & vec3u(1u, 2u, 4u)) != vec3u(0u);
    // What is driven by one tool comes into the reach of no other within the step: the balls have room for its way.
    let near = sweep_hits(end, at + SWEEP_STEP_ROWS, of_images, images);
    if near == 0u {
        return vec3f(0.0);
    }
    let step = SweepStep(end, lasts, planes & (end == vec3f(0.0)), near, of_images, of_images + images, at);
    let first_tool = u32(templates.pool[of_images + firstTrailingBit(near)].w);
    let shape = u32(templates.pool[step.of_tools + 2u * first_tool + 1u].x);
    if (near & (near - 1u)) == 0u && shape != CURVE_SHAPE {
        return sweep_back_one(step) * (-lasts / 6.0);
    }
    var flow = Flow(end, lasts, vec3f(0.0), 0u, vec3f(0.0), 0.0, 1.0, near, NO_END, 0u);
    while flow.stage < 4u {
        flow = with_three_fields(with_field(flow, step), step);
    }
    return flow.total * (-lasts / 6.0);
}

/// Where the flow has come from through steps that follow each other.
struct SweptRun {
    /// The way back, metric.
    moved: vec3f,
    /// The last of the steps before them.
    last: i32,
}

/// The flow of a tool alone, which is no curve and has no image, back from a step that may move a point, as far as the
/// tool moves it and goes by one screw. All goes on in the tool's own place at the start of a step: there the screw is
/// the same for all these steps, and what is read for the first of them serves the others. `form` and `kind`: the rows
/// of the tool.
fn sweep_back_alone(end: vec3f, last: i32, progress: f32, head: vec4f, form: vec4f, kind: vec4f) -> SweptRun {
    let step_rows = SWEEP_STEP_ROWS + SWEEP_TOOL_ROWS;
    let step = u32(head.x) + u32(last) * step_rows;
    let time = sweep_texel(step);
    let screw = sweep_texel(step + SWEEP_STEP_ROWS + 4u);
    let moves = sweep_texel(step + SWEEP_STEP_ROWS + 5u);
    let place = vec4f(end, 1.0);
    var p = vec3f(
        dot(sweep_texel(step + SWEEP_STEP_ROWS + 1u), place),
        dot(sweep_texel(step + SWEEP_STEP_ROWS + 2u), place),
        dot(sweep_texel(step + SWEEP_STEP_ROWS + 3u), place),
    );
    var scale = moves.w;
    var lasts = min(time.y, progress - time.x);
    var done = 0u;
    var is_moved = false;
    loop {
        var at = p;
        var since = lasts;
        var total = vec3f(0.0);
        for (var stage = 0u; stage < 4u; stage++) {
            let posed = posed_in_step(at, since, screw, moves);
            let distance = scale * posed.growth * tool_distance(posed.place, u32(kind.x), form);
            let flow = tool_field(distance * kind.y) * posed.velocity;
            total += select(1.0, 2.0, stage == 1u || stage == 2u) * flow;
            let next = select(0.5, 1.0, stage == 2u) * lasts;
            at = p - next * flow;
            since = lasts - next;
        }
        let goes_on = any(total != vec3f(0.0));
        is_moved = is_moved || goes_on;
        p -= lasts / 6.0 * total;
        if !goes_on || done == u32(time.z) {
            break;
        }
        // In the tool's place at the start of the step before, which is as long.
        let before = posed_in_step(p, -time.y, screw, moves);
        p = before.place;
        scale *= before.growth;
        lasts = time.y;
        done++;
    }
    // The rows are a turn back, divided by the scale.
    let first = step - done * step_rows + SWEEP_STEP_ROWS;
    let row_x = sweep_texel(first + 1u);
    let row_y = sweep_texel(first + 2u);
    let row_z = sweep_texel(first + 3u);
    let from_origin = (p - vec3f(row_x.w, row_y.w, row_z.w)) * scale * scale;
    let start = row_x.xyz * from_origin.x + row_y.xyz * from_origin.y + row_z.xyz * from_origin.z;
    return SweptRun(select(vec3f(0.0), start - end, is_moved), last - i32(done) - 1);
}

/// The way back of what one copy of a cluster moves, from a place of the box. `row`: its first row in the pool.
fn sweep_moved(place: vec3f, progress: f32, held: u32, row: u32) -> vec3f {
    let whole = templates.pool[held];
    let head = templates.pool[row];
    let acting = templates.pool[row + 1u];
    let signs = templates.pool[row + 2u].xyz;
    let images = u32(acting.y);
    let of_images = held + u32(acting.z);
    let step_rows = SWEEP_STEP_ROWS + SWEEP_TOOL_ROWS * u32(head.w);
    let form = templates.pool[of_images + images];
    let kind = templates.pool[of_images + images + 1u];
    let is_alone = images == 1u && u32(kind.x) != CURVE_SHAPE;
    let start = signs * place;
    var last = i32(acting.x);
    // Constraints by coordinate do a part of it.
    if progress < whole.y {
        last = i32(sweep_step_at(progress, u32(last), head));
    }
    var moved = vec3f(0.0);
    // Blocks stay known when the point moves: their steps are asked for themselves.
    var known = vec2i(-1);
    loop {
        let found = sweep_find(start + moved, last, head, known);
        let i = found.index;
        if i < 0 {
            break;
        }
        known = found.known;
        if is_alone {
            let run = sweep_back_alone(start + moved, i, progress, head, form, kind);
            moved += run.moved;
            last = run.last;
        } else {
            let at = u32(head.x) + u32(i) * step_rows;
            let time = sweep_texel(at);
            let lasts = min(time.y, progress - time.x);
            moved += sweep_back(start + moved, at, lasts, of_images, images, u32(whole.z));
            last = i - 1;
        }
    }
    return signs * moved;
}

/// p0: progress. `held`: index in the pool, 0 if nothing moves.
fn displace_sweep(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f, held: u32) -> Displaced {
    if held == 0u || p0.x <= 0.0 {
        return at_rest(q);
    }
    let start = size * (q - 0.5);
    if any(start < templates.pool[held + 1u].xyz) || any(start > templates.pool[held + 2u].xyz) {
        return at_rest(q);
    }
    // At most one of them moves a place, and brings it into the reach of no other.
    var moved = vec3f(0.0);
    let copies = u32(templates.pool[held].x);
    for (var copy = 0u; copy < copies; copy++) {
        let row = held + SWEEP_HEAD + SWEEP_COPY_ROWS * copy;
        if all(start >= templates.pool[row + 3u].xyz) && all(start <= templates.pool[row + 4u].xyz) {
            moved += sweep_moved(start, p0.x, held, row);
        }
    }
    return Displaced(q + moved / size, 1.0);
}
