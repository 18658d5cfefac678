//! What the selected template leaves alone (its alignment), and what its displacement gives way to (its constraint).
//! Tissue that lies inside of what is left alone is offered too: a template would drag it through what encloses it.

use egui::{Color32, Label, Sense, Stroke, Ui, vec2};

use crate::app::kit::icon::Icon;
use crate::app::kit::theme::{Palette, control_height};
use crate::app::kit::widget::{self, Named as _, NumberRow};
use crate::app::panel::tissue;
use crate::app::session::Command;
use crate::app::words::kept::{segment, w};
use crate::app::words::{fill, in_sentence};
use crate::data::{CoarseLabels, RECIPE_COLORS_SRGB, Segment, Segmentation, TimeSlices};
use crate::data::{Pending, poll_once};
use crate::document::{
    Align, Constrain, ConstrainBy, Edit, Illustration, PlacedTemplate, Recipe, keep_sets,
};

/// The largest that sliders offer; a document may hold larger ones.
const MOST_DEPTH: f32 = 0.3;
const MOST_THICKNESS: f32 = 0.05;
/// Taken as kept when an author first chooses tissue, as far as the subject has it: what pictures mostly lay bare.
const FIRST_KEPT: [&str; 4] = ["bone", "femur", "tibia", "core"];
/// Segments listed before the list scrolls.
const LISTED: usize = 8;

#[derive(Clone, Copy, PartialEq)]
enum Leaves {
    Nothing,
    Deep,
    Tissue,
}

#[derive(Clone, Copy, PartialEq)]
enum Yields {
    Nothing,
    Shorter,
    Weaker,
    Whole,
    Each,
    Parts,
}

/// What lies inside of the tissue that a template leaves alone. Found when the template or the segments change.
#[derive(Default)]
pub(crate) struct Inside {
    labels: Option<CoarseLabels>,
    /// What the answer is about: the names that are kept, and all segments.
    of: Option<(Vec<String>, Vec<Segment>)>,
    names: Vec<String>,
}

impl Inside {
    /// The subject has other segments.
    pub(crate) fn set_labels(&mut self, segmentation: Option<&Segmentation>) {
        self.labels = segmentation.map(CoarseLabels::of);
        self.of = None;
    }

    /// Names of the segments that lie inside of those that the template keeps.
    pub(crate) fn names(
        &mut self,
        template: Option<&PlacedTemplate>,
        segments: &[Segment],
    ) -> &[String] {
        let align = template.map(|template| &template.align);
        let (Some(Align::Segment { keep, .. }), Some(labels)) = (align, &self.labels) else {
            return &[];
        };
        let is_known =
            |(names, all): &(Vec<String>, Vec<Segment>)| names == keep && all == segments;
        if !self.of.as_ref().is_some_and(is_known) {
            let of = (keep.clone(), segments.to_vec());
            let (labels, (keep, all)) = (labels.clone(), of.clone());
            // Without time slices the answer is there at once.
            let mut work: Pending<Vec<String>> = Box::pin(async move {
                let is_kept = |segment: &Segment| keep.iter().any(|name| means(name, segment));
                labels.inside(&all, is_kept, &TimeSlices::unlimited()).await
            });
            self.names = poll_once(&mut work).unwrap_or_default();
            self.of = Some(of);
        }
        &self.names
    }
}

/// Both parts. `inside` are the names of the segments that lie inside of those that the template keeps; what other
/// templates of the illustration keep is offered first.
pub(crate) fn ui(
    ui: &mut Ui,
    template: &PlacedTemplate,
    illustration: &Illustration,
    segments: &[Segment],
    inside: &[String],
    commands: &mut Vec<Command>,
) {
    let (all, index) = (&illustration.templates, template.index);
    let segments = &with_recipes(segments, &illustration.recipes);
    ui.push_id(("leaves alone", index), |ui| {
        align_ui(ui, template, all, segments, inside, commands);
    });
    // A constraint needs tissue to give way to.
    if !segments.is_empty() || template.constrain.is_some() {
        ui.push_id(("gives way", index), |ui| {
            constrain_ui(ui, template, all, segments, commands);
        });
    }
}

/// The segments, and those that recipes are still being run for, under labels that no voxel has.
fn with_recipes(segments: &[Segment], recipes: &[Recipe]) -> Vec<Segment> {
    let mut all = segments.to_vec();
    for recipe in recipes {
        if segments.iter().all(|segment| segment.name != recipe.name) {
            let color = RECIPE_COLORS_SRGB[recipe.index % RECIPE_COLORS_SRGB.len()];
            all.push(Segment {
                label: u16::MAX - recipe.index as u16,
                name: recipe.name.clone(),
                color_srgb: Some(recipe.color_srgb.unwrap_or(color)),
            });
        }
    }
    all
}

/// What a set starts with: the one that another template has, else the usual, else the only tissue that there is.
fn first_set(all: &[PlacedTemplate], segments: &[Segment]) -> Vec<String> {
    if let Some(set) = keep_sets(all).into_iter().next() {
        return set;
    }
    let has = |name: &str| segments.iter().any(|s| s.name == name);
    let usual = FIRST_KEPT.iter().filter(|name| has(name));
    let usual: Vec<String> = usual.map(|&name| name.to_owned()).collect();
    match segments {
        [only] if usual.is_empty() => vec![only.name.clone()],
        _ => usual,
    }
}

fn align_ui(
    ui: &mut Ui,
    template: &PlacedTemplate,
    all: &[PlacedTemplate],
    segments: &[Segment],
    inside: &[String],
    commands: &mut Vec<Command>,
) {
    let set = |align: Align| Edit::SetAlign {
        template: template.index,
        align,
    };
    let current = match template.align {
        Align::Axis => Leaves::Nothing,
        Align::Surface { .. } => Leaves::Deep,
        Align::Segment { .. } => Leaves::Tissue,
    };
    ui.label(w().leaves).on_hover_text(w().leaves_hint);
    let options = [
        (Leaves::Nothing, w().nothing, w().nothing_hint),
        (Leaves::Deep, w().deep, w().deep_hint),
        (Leaves::Tissue, w().tissue, w().tissue_hint),
    ];
    if let Some(leaves) = widget::explained(ui, w().leaves, &options, current) {
        let align = match leaves {
            Leaves::Nothing => Align::Axis,
            Leaves::Deep => Align::Surface {
                depth: Align::DEFAULT_DEPTH,
                thickness: Align::DEFAULT_THICKNESS,
            },
            Leaves::Tissue => Align::Segment {
                keep: first_set(all, segments),
                thickness: Align::DEFAULT_THICKNESS,
            },
        };
        commands.push(Command::Apply(set(align)));
    }
    match &template.align {
        Align::Axis => {}
        Align::Surface { depth, thickness } => {
            let row = length_row(
                w().depth,
                w().depth_hint,
                *depth,
                Align::DEFAULT_DEPTH,
                MOST_DEPTH,
            );
            if let Some(change) = row.ui(ui) {
                let edit = change.map(|depth| {
                    set(Align::Surface {
                        depth: depth as f32,
                        thickness: *thickness,
                    })
                });
                commands.push(widget::command(edit));
            }
            if let Some(change) = blend_row(*thickness).ui(ui) {
                let edit = change.map(|thickness| {
                    set(Align::Surface {
                        depth: *depth,
                        thickness: thickness as f32,
                    })
                });
                commands.push(widget::command(edit));
            }
        }
        Align::Segment { keep, thickness } => {
            if inside_ui(ui, inside) {
                let keep = [keep, inside].concat();
                let thickness = *thickness;
                commands.push(Command::Apply(set(Align::Segment { keep, thickness })));
            }
            if let Some(keep) = segments_ui(ui, w().leaves, keep, segments) {
                let thickness = *thickness;
                commands.push(Command::Apply(set(Align::Segment { keep, thickness })));
            }
            if let Some(change) = blend_row(*thickness).ui(ui) {
                let edit = change.map(|thickness| {
                    set(Align::Segment {
                        keep: keep.clone(),
                        thickness: thickness as f32,
                    })
                });
                commands.push(widget::command(edit));
            }
        }
    }
}

/// Offers to keep what lies inside; true if that is wanted.
fn inside_ui(ui: &mut Ui, inside: &[String]) -> bool {
    if inside.is_empty() {
        return false;
    }
    let weak = Palette::get(ui).weak;
    let titles: Vec<String> = inside
        .iter()
        .map(|name| in_sentence(&segment(name)))
        .collect();
    let text = fill(w().inside, &[&titles.join(", ")]);
    ui.add(Label::new(egui::RichText::new(text).color(weak)).wrap());
    let button = widget::labelled_button(ui, Icon::Plus, w().keep_inside, false, true);
    button.on_hover_text(w().keep_inside_hint).clicked()
}

fn constrain_ui(
    ui: &mut Ui,
    template: &PlacedTemplate,
    all: &[PlacedTemplate],
    segments: &[Segment],
    commands: &mut Vec<Command>,
) {
    let set = |constrain: Option<Constrain>| {
        Command::Apply(Edit::SetConstrain {
            template: template.index,
            constrain,
        })
    };
    let current = match template.constrain.as_ref().map(|c| c.by) {
        None => Yields::Nothing,
        Some(ConstrainBy::Displacement) => Yields::Shorter,
        Some(ConstrainBy::Coordinate) => Yields::Weaker,
        Some(ConstrainBy::Rigid) => Yields::Whole,
        Some(ConstrainBy::Bodies) => Yields::Each,
        Some(ConstrainBy::Parts) => Yields::Parts,
    };
    ui.add_space(4.0);
    ui.label(w().yields).on_hover_text(w().yields_hint);
    let options = [
        (Yields::Nothing, w().nothing, w().unprotected_hint),
        (Yields::Shorter, w().shorter, w().shorter_hint),
        (Yields::Weaker, w().weaker, w().weaker_hint),
        (Yields::Whole, w().whole, w().whole_hint),
        (Yields::Each, w().bodies, w().bodies_hint),
        (Yields::Parts, w().parts, w().parts_hint),
    ];
    if let Some(yields) = widget::explained(ui, w().yields, &options, current) {
        let keep = match &template.constrain {
            Some(constrain) => constrain.keep.clone(),
            None => first_set(all, segments),
        };
        let by = match yields {
            Yields::Nothing => None,
            Yields::Shorter => Some(ConstrainBy::Displacement),
            Yields::Weaker => Some(ConstrainBy::Coordinate),
            Yields::Whole => Some(ConstrainBy::Rigid),
            Yields::Each => Some(ConstrainBy::Bodies),
            Yields::Parts => Some(ConstrainBy::Parts),
        };
        commands.push(set(by.map(|by| Constrain { by, keep })));
    }
    if let Some(Constrain { by, keep }) = &template.constrain
        && let Some(keep) = segments_ui(ui, w().yields, keep, segments)
    {
        commands.push(set(Some(Constrain { by: *by, keep })));
    }
}

fn length_row<'a>(
    name: &'a str,
    summary: &'a str,
    value: f32,
    default: f32,
    most: f32,
) -> NumberRow<'a> {
    NumberRow {
        name,
        summary,
        value: f64::from(value),
        default: Some(f64::from(default)),
        range: [0.0, f64::from(most.max(value))],
        unit: "",
        decimals: 3,
    }
}

fn blend_row(thickness: f32) -> NumberRow<'static> {
    length_row(
        w().blend,
        w().blend_hint,
        thickness,
        Align::DEFAULT_THICKNESS,
        MOST_THICKNESS,
    )
}

/// True if an entry of `keep` (a name, or a label's number) means this segment.
fn means(entry: &str, segment: &Segment) -> bool {
    entry.eq_ignore_ascii_case(&segment.name) || entry.parse() == Ok(segment.label)
}

/// Check boxes for the segments, with their colours. Returns the set when one is changed; entries that mean no
/// segment of this subject stay in it.
fn segments_ui(
    ui: &mut Ui,
    what: &str,
    keep: &[String],
    segments: &[Segment],
) -> Option<Vec<String>> {
    if segments.is_empty() {
        let weak = Palette::get(ui).weak;
        ui.add(Label::new(egui::RichText::new(w().no_segments).color(weak)).wrap());
        return None;
    }
    let mut changed = None;
    let mut list = |ui: &mut Ui| {
        for entry in tissue::listed(segments) {
            let mut is_on = keep.iter().any(|name| means(name, entry));
            let title = segment(&entry.name);
            widget::row(ui, |ui| {
                let name = format!("{what}: {title}");
                let response = ui.checkbox(&mut is_on, "").named(name);
                let (swatch, _) = ui.allocate_exact_size(vec2(12.0, 12.0), Sense::hover());
                let [r, g, b] = entry.color_srgb.unwrap_or([160; 3]);
                let line = Stroke::new(1.0, Palette::get(ui).line);
                ui.painter().rect(
                    swatch,
                    3.0,
                    Color32::from_rgb(r, g, b),
                    line,
                    egui::StrokeKind::Inside,
                );
                let text = ui.add(Label::new(&title).truncate().sense(Sense::click()));
                if text.clicked() {
                    is_on = !is_on;
                }
                if response.changed() || text.clicked() {
                    let mut names: Vec<String> = keep
                        .iter()
                        .filter(|name| !means(name, entry))
                        .cloned()
                        .collect();
                    if is_on {
                        names.push(entry.name.clone());
                    }
                    changed = Some(names);
                }
            });
        }
    };
    if segments.len() <= LISTED {
        list(ui);
    } else {
        egui::ScrollArea::vertical()
            .id_salt("segments")
            .max_height(LISTED as f32 * (control_height() + 4.0))
            .auto_shrink([false, true])
            .show(ui, list);
    }
    changed
}
