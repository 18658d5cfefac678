use crate::data::{Carver, FieldSamples, Grids, Resources};
use crate::displace::{
    Given, GridPlace, Interpolant, MAX_PARAM_FLOATS, Missed, Reach, Samples, Sweeping, Tool,
    ToolFile, ToolShape, ToolWay,
};
use crate::document::{PlacedTemplate, TemplateData};
use glam::Vec3;

/// A template as its kind sees it; `samples` are those of a `field`, `carver` is what a `carve` cuts by.
pub(super) fn given(
    template: &PlacedTemplate,
    samples: Option<&FieldSamples>,
    carver: Option<&Carver>,
) -> Given {
    let mut floats = Vec::with_capacity(MAX_PARAM_FLOATS);
    template.params.iter().for_each(|v| v.pack(&mut floats));
    floats.resize(MAX_PARAM_FLOATS, 0.0);
    let points = match &template.data {
        TemplateData::Points(held) => Some(held.clone()),
        _ => None,
    };
    let samples = samples.map(|FieldSamples(held)| Samples {
        most: held.dims.iter().copied().max().unwrap_or(1),
        shift: held.shift,
    });
    Given {
        size: acting_size(template),
        p: std::array::from_fn(|i| floats[i]),
        points,
        samples,
        tool: carver.map(|carver| Tool {
            half: carver.half,
            room: carver.room,
            cell: carver.cell,
        }),
        tools: match &template.data {
            TemplateData::Tools(held) => Some(held.clone()),
            _ => None,
        },
    }
}

/// What a template reaches with the parameters and the size it has, template space.
pub fn reach(template: &PlacedTemplate, resources: &Resources) -> Reach {
    let samples = resources.field(template);
    let carver = resources.carver(template).map(|carver| &**carver);
    (template.kind.facts().reach)(&given(&resources.acting(template), samples, carver))
}

/// What the shader of an `rbf` that acts ([`PlacedTemplate::acting`]) reads besides its parameters
/// (shaders/displace/rbf.wgsl).
pub fn solved_points(template: &PlacedTemplate) -> Vec<[f32; 4]> {
    Interpolant::of(&given(template, None, None)).pack()
}

/// Sides of the box that a template acts in, subject units; along a curve, of the box laid along it.
fn acting_size(template: &PlacedTemplate) -> Vec3 {
    let bent = template.bent();
    bent.map_or(template.placement.size, |bent| bent.size())
}

/// What the shader of a `sweep` that acts ([`PlacedTemplate::acting`]) reads besides its parameters, for steps that
/// begin at texel `first` of their texture; `first` is moved behind them (shaders/displace/sweep.wgsl). `grid_of` says
/// where in it the grid of a mesh lies.
pub fn sweep_rows(
    template: &PlacedTemplate,
    first: &mut usize,
    grid_of: &dyn Fn(&ToolFile) -> Option<GridPlace>,
) -> Vec<[f32; 4]> {
    let given = given(template, None, None);
    Sweeping::of(&given).rows(given.p[0], first, grid_of)
}

/// What a sweep has, as bits of `drawn_kinds` ([`DRAWN_OF_SWEEPS`](crate::displace::DRAWN_OF_SWEEPS)), from its rows
/// ([`sweep_rows`]).
pub fn drawn_in_sweep(rows: &[[f32; 4]]) -> u32 {
    Sweeping::drawn_in(rows)
}

/// The steps of a `sweep` as its shader reads them; none of other kinds.
pub fn sweep_texels(template: &PlacedTemplate) -> Vec<[f32; 4]> {
    match &template.data {
        TemplateData::Tools(tools) => Sweeping::new(tools, acting_size(template)).texels(),
        _ => Vec::new(),
    }
}

/// How the tools of a `sweep` go with the parameters that it has, each in its place in the list; none of other kinds.
/// The form of a mesh is drawn as far as its grid is there.
pub fn tool_ways(template: &PlacedTemplate, grids: &Grids) -> Vec<Option<ToolWay>> {
    match &template.data {
        TemplateData::Tools(tools) => {
            let progress = given(template, None, None).p[0];
            let outline = |shape: &ToolShape| grids.outline(shape);
            Sweeping::ways(tools, acting_size(template), progress, &outline)
        }
        _ => Vec::new(),
    }
}

/// Width that a texture of the map of a `sweep` has to show in eight texels, subject units; none of other kinds. It is
/// the smallest coating, or less of one in which tissue is sheared.
pub fn least_coat(template: &PlacedTemplate) -> Option<f32> {
    match &template.data {
        TemplateData::Tools(tools) => Sweeping::still(tools, acting_size(template)).least_width(),
        _ => None,
    }
}

/// The control points of an `rbf` that its map misses as it acts ([`PlacedTemplate::acting`]), because another point
/// with another displacement stands at the same place; none for other kinds, and none where it is switched off.
pub fn missed_points(template: &PlacedTemplate) -> Vec<Missed> {
    let template = template.acting();
    if !template.enabled || !matches!(template.data, TemplateData::Points(_)) {
        return Vec::new();
    }
    let given = given(&template, None, None);
    Interpolant::of(&given).missed(&given)
}

/// Lines of a lattice on the tissue of an `rbf`'s middle plane (z = ½), as they lie when it is bent, subject space.
pub fn bent_lattice(template: &PlacedTemplate) -> Vec<Vec<Vec3>> {
    let template = template.acting();
    let interpolant = Interpolant::of(&given(&template, None, None));
    let place = |q: Vec3| template.subject_from_template(q);
    let lines = interpolant.bent_lattice().into_iter();
    lines
        .map(|line| line.into_iter().map(place).collect())
        .collect()
}
