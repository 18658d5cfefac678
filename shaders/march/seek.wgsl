// The march of a ray through the deformed space. The march leaps over empty cells and takes samples elsewhere; the map
// determines the length of each step (Correa, section 7.5.2, adaptive sampling).
// needs: types.wgsl affine.wgsl bind/frame.wgsl bind/grid.wgsl displace/compose.wgsl march/overrides.wgsl
//   march/ray.wgsl march/view.wgsl march/opacity.wgsl march/sample.wgsl

/// A ray through a point of the picture; constant while the ray is marched.
struct Ray {
    /// The eye, subject space.
    origin: vec3f,
    /// Unit, subject space; no component is 0.
    dir: vec3f,
    /// One over each component of `dir`.
    inverse_dir: vec3f,
    /// Sign of each component of `dir`.
    forward: vec3f,
    /// Direction of the ray away from the eye, view space, unit length.
    dir_in_view: vec3f,
    /// Distances from the eye at which the ray enters the box of the object (at least 0) and leaves the box.
    t_start: f32,
    t_end: f32,
}

/// Where the march along a ray has got to.
struct Walk {
    /// Distances from the eye of the current sample and of the sample before it.
    t: f32,
    t_before: f32,
    /// The samples at `t` and at `t_before`.
    here: Sample,
    before: Sample,
    /// Masks of the templates that may reach the grid cells of the samples at `t` and at `t_before`. A cut between the
    /// two samples may belong to a template that reaches only the cell of the earlier sample.
    mask: u32,
    mask_before: u32,
    /// Distance from the eye at which the ray leaves the grid cell of the sample at `t`; if that cell is empty, the
    /// distance at which the ray leaves the empty cells around that cell.
    t_cell: f32,
}

/// The ray through a point of the picture.
fn ray_through(pixel: vec2f) -> Ray {
    let dir_in_view = dir_in_view_of(pixel);
    return ray_along(offset_of(frame.subject_from_view), apply_linear(frame.subject_from_view, dir_in_view), dir_in_view);
}

/// A ray from a place in a unit direction, both in subject space and the direction in view space too.
fn ray_along(origin: vec3f, along: vec3f, dir_in_view: vec3f) -> Ray {
    let dir = without_zeros(along);
    let inverse_dir = 1.0 / dir;
    let span = ray_in_box(origin, inverse_dir, frame.bounds_min.xyz, frame.bounds_max.xyz);
    let forward = select(vec3f(-1.0), vec3f(1.0), dir > vec3f(0.0));
    return Ray(origin, dir, inverse_dir, forward, dir_in_view, max(span.x, 0.0), span.y);
}

/// The state of the march along a ray before the first sample.
fn walk_along(ray: Ray) -> Walk {
    let nothing = Sample(vec3f(0.0), 0.0, 0.0, 1.0, 0u);
    return Walk(ray.t_start + frame.step * frame.first_step, ray.t_start, nothing, nothing, 0u, 0u, -1.0);
}

/// Cell of the skip grid at a point. x: mask of the templates that may reach the cell; y: 0 if something in the cell
/// may be visible. Without a grid, every template may reach every point, and every point may be visible.
fn cell_at(pos: vec3f) -> vec2u {
    if has_grid == 0u || grid.is_used == 0u {
        return vec2u(0xffffffffu, 0u);
    }
    let local = floor((pos - grid.origin_min.xyz) / grid.cell_size.xyz);
    let cell = clamp(vec3i(local), vec3i(0), vec3i(grid.cells.xyz) - 1);
    return textureLoad(grid_cells, cell, 0).xy;
}

/// Leaps over empty cells to the next cell that may hold something visible. If the sample before was visible, the march
/// does not leap, since the march has to find the end of that tissue first.
fn leap(ray: Ray, walk: ptr<function, Walk>) {
    loop {
        if (*walk).t >= ray.t_end {
            break;
        }
        if has_grid == 0u || grid.is_used == 0u {
            (*walk).mask = 0xffffffffu;
            (*walk).t_cell = ray.t_end;
            break;
        }
        let local = floor((ray.origin + ray.dir * (*walk).t - grid.origin_min.xyz) / grid.cell_size.xyz);
        let cell = clamp(local, vec3f(0.0), vec3f(grid.cells.xyz) - 1.0);
        let content = textureLoad(grid_cells, vec3i(cell), 0).xy;
        let reach = max(f32(content.y), 1.0);
        let plane = select(cell + 1.0 - reach, cell + reach, ray.dir > vec3f(0.0));
        let exits = (grid.origin_min.xyz + plane * grid.cell_size.xyz - ray.origin) * ray.inverse_dir;
        // Ahead of the sample: a ray almost along a face of cells may be past the face and, by rounding, still in the
        // cell; the march would not go on.
        (*walk).t_cell = max(min(exits.x, min(exits.y, exits.z)), (*walk).t) + frame.step * 0.01;
        (*walk).mask = content.x;
        if content.y == 0u || (*walk).before.opacity > VISIBLE {
            break;
        }
        (*walk).t_before = max((*walk).t_cell, (*walk).t + frame.step * 0.01);
        // The samples of a ray lie on one row of places, whatever it leaps over, and the row begins elsewhere for each
        // sample of a pixel. If the steps began anew where a cell begins, they would be seen as layers wherever tissue
        // grows denser over several of them.
        let steps = ceil(((*walk).t_before - ray.t_start) / frame.step - frame.first_step);
        (*walk).t = ray.t_start + (steps + frame.first_step) * frame.step;
        (*walk).mask_before = 0u;
    }
}

/// Where a cut parts tissue from nothing, the tissue may be thinner than a step: the rim of a flap. Over the cut the
/// map jumps: its two sides come from places so many times as far apart as the samples are.
const TORN: f32 = 8.0;
/// Halvings of a step in which a cut parts nothing from nothing.
const SEARCH_TURNS: u32 = 5u;

/// A search for a cut between two samples in which nothing is seen.
struct Search {
    /// Distances from the eye between which the cut lies.
    low: f32,
    high: f32,
    /// The samples before and behind the cut.
    before: Sample,
    end: Sample,
    /// Distance of the second sample from the eye.
    t_end: f32,
    /// Turns left.
    turns: u32,
}

/// True if one of two samples lies in a gap and the other does not.
fn are_parted(a: Sample, b: Sample) -> bool {
    return (a.continuity < 0.0) != (b.continuity < 0.0);
}

/// True if a cut lies between two samples that are `way` apart. Samples with empty cells between them count as one.
fn is_torn_between(last: Sample, here: Sample, way: f32) -> bool {
    return way > 0.1 * frame.step && (are_parted(last, here) || distance(here.pos, last.pos) > TORN * way);
}

/// The search after a look at a place.
fn narrowed(search: Search, found: Sample, t: f32) -> Search {
    let is_nearer = distance(found.pos, search.end.pos) < distance(found.pos, search.before.pos);
    let is_behind = select(is_nearer, !are_parted(found, search.end), are_parted(search.before, search.end));
    var next = search;
    next.low = select(t, search.low, is_behind);
    next.high = select(search.high, t, is_behind);
    next.turns--;
    return next;
}

/// Seeks the next visible sample, or the first sample behind a visible one. False if the ray leaves the box of the
/// object before such a sample.
fn seek(ray: Ray, walk: ptr<function, Walk>) -> bool {
    var is_found = false;
    (*walk).here = (*walk).before;
    loop {
        var t_stop = ray.t_end;
        // This loop passes through empty cells and through cells that no template reaches.
        loop {
            leap(ray, walk);
            // Cells that no template reaches are sampled without the map.
            t_stop = min((*walk).t_cell, ray.t_end);
            let is_mapped = (*walk).mask != 0u && drawn_kinds != 0u;
            loop {
                if is_mapped || (*walk).t >= t_stop || is_found {
                    break;
                }
                (*walk).here = sample_unmoved(ray.origin + ray.dir * (*walk).t);
                is_found = (*walk).here.opacity > VISIBLE || (*walk).before.opacity > VISIBLE;
                if is_found {
                    break;
                }
                (*walk).t_before = (*walk).t;
                (*walk).mask_before = (*walk).mask;
                (*walk).t += frame.step;
            }
            if is_mapped || is_found || (*walk).t >= ray.t_end {
                break;
            }
        }
        if drawn_kinds != 0u {
            var search: Search;
            loop {
                if (*walk).mask == 0u || (*walk).t >= t_stop || is_found {
                    break;
                }
                let last = (*walk).here;
                let is_searching = search.turns > 0u;
                let mask = select((*walk).mask, (*walk).mask | (*walk).mask_before, is_searching);
                (*walk).here = sample_mapped(map_point(ray.origin + ray.dir * (*walk).t, mask));
                is_found = (*walk).here.opacity > VISIBLE || (*walk).before.opacity > VISIBLE;
                if is_found {
                    break;
                }
                if is_searching {
                    search = narrowed(search, (*walk).here, (*walk).t);
                } else if frame.is_finished != 0u && is_torn_between(last, (*walk).here, (*walk).t - (*walk).t_before) {
                    search = Search((*walk).t_before, (*walk).t, last, (*walk).here, (*walk).t, SEARCH_TURNS);
                }
                if search.turns > 0u {
                    (*walk).t = 0.5 * (search.low + search.high);
                    continue;
                }
                var before = last.pos;
                if is_searching {
                    // Nothing there: on from the end of the step.
                    (*walk).here = search.end;
                    (*walk).t = search.t_end;
                    before = search.before.pos;
                }
                // The step follows the Jacobian: compressed tissue gets more samples, stretched tissue fewer.
                let way = max((*walk).t - (*walk).t_before, 0.25 * frame.step);
                let stretch = clamp(distance((*walk).here.pos, before) / way, 0.6, 3.0);
                (*walk).t_before = (*walk).t;
                (*walk).mask_before = (*walk).mask;
                (*walk).t += frame.step / stretch;
            }
        }
        if is_found || (*walk).t >= ray.t_end {
            break;
        }
    }
    return is_found;
}
