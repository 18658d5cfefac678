// Where between two samples the opacity jumps: found by bisection.
//
//   before o---------x----o here     x the crossing; light and opacity are taken at the sample next to it that has
//            level ¯¯¯               something in it
//
// needs: types.wgsl bind/frame.wgsl displace/compose.wgsl march/opacity.wgsl march/sample.wgsl march/seek.wgsl

/// A change of opacity from sample to sample that counts as a crossing, to be found exactly.
const JUMP: f32 = 0.04;
/// Halvings of a step to find a crossing: 2^-7 of a step is far below a pixel.
const BISECTIONS: u32 = 7u;

/// What lies between two samples of a ray.
struct Crossing {
    /// The last or first sample that has something in it.
    edge: Sample,
    /// Where the opacity changes: the crossing, or the middle between the samples. Distance from the eye.
    t_edge: f32,
    /// Where normal and colour are taken: at the crossing, or at the second sample. Distance from the eye.
    t_shade: f32,
    /// True if the opacity jumps.
    is_jump: bool,
    /// True if it grows.
    is_rising: bool,
    /// Templates that reach the cell of either sample.
    mask: u32,
}

/// A search for a crossing.
struct Bisection {
    /// Distances from the eye between which the crossing lies.
    low: f32,
    high: f32,
    /// The opacity at which it lies.
    level: f32,
    is_rising: bool,
    /// The last or first sample that has something in it.
    edge: Sample,
    /// The sample one step behind the crossing.
    behind: Sample,
}

/// Where the search looks next; in its last turn a step behind the crossing.
fn next_of(search: Bisection, is_last: bool) -> f32 {
    return select(0.5 * (search.low + search.high), search.high + frame.step, is_last);
}

/// Takes over the sample at the new place.
fn narrow(search: ptr<function, Bisection>, at: f32, found: Sample, is_last: bool) {
    let is_in = found.opacity > (*search).level;
    if is_last {
        (*search).behind = found;
    } else if is_in == (*search).is_rising {
        (*search).high = at;
    } else {
        (*search).low = at;
    }
    if is_in && !is_last {
        (*search).edge = found;
    }
}

/// Finds what lies between the last two samples. Moves the second to one step behind a surface, where that is the same
/// tissue.
fn refine(ray: Ray, walk: ptr<function, Walk>) -> Crossing {
    let here = (*walk).here;
    let before = (*walk).before;
    let is_rising = here.opacity > before.opacity;
    let is_jump = abs(here.opacity - before.opacity) > JUMP || min(here.opacity, before.opacity) <= VISIBLE;
    var search: Bisection;
    search.low = (*walk).t_before;
    search.high = (*walk).t;
    search.level = 0.5 * (here.opacity + before.opacity);
    search.is_rising = is_rising;
    search.edge = before;
    if is_rising || !is_jump {
        search.edge = here;
    }
    search.behind = here;
    let mask = (*walk).mask | (*walk).mask_before;
    // Behind a surface towards nothing the first stretch has always the same length, and so the same share of the
    // colour. If that stretch had the remaining length of the step, the surface would fade wherever a sample happens to
    // lie right behind the surface. One turn of the loop after the halvings takes the sample at its end.
    let has_first_stretch = is_rising && before.opacity <= VISIBLE;
    // Two loops: where no template reaches, a turn costs no map.
    let is_mapped = mask != 0u && drawn_kinds != 0u;
    let turns = select(0u, BISECTIONS + select(0u, 1u, has_first_stretch), is_jump);
    for (var turn = select(0u, turns, !is_mapped); turn > 0u; turn--) {
        let is_last = has_first_stretch && turn == 1u;
        let at = next_of(search, is_last);
        narrow(&search, at, sample_unmoved(ray.origin + ray.dir * at), is_last);
    }
    if drawn_kinds != 0u {
        for (var turn = select(0u, turns, is_mapped); turn > 0u; turn--) {
            let is_last = has_first_stretch && turn == 1u;
            let at = next_of(search, is_last);
            narrow(&search, at, sample_mapped(map_point(ray.origin + ray.dir * at, mask)), is_last);
        }
    }
    let middle = 0.5 * ((*walk).t_before + (*walk).t);
    let t_edge = select(middle, select(search.low, search.high, is_rising), is_jump);
    // Thin tissue keeps the sample that found it.
    if has_first_stretch && search.behind.opacity >= 0.5 * here.opacity && t_edge + frame.step > (*walk).t {
        (*walk).here = search.behind;
        (*walk).t = t_edge + frame.step;
    }
    return Crossing(search.edge, t_edge, select((*walk).t, t_edge, is_jump), is_jump, is_rising, mask);
}
