use serde_json::{Value, json};

use super::edits::{index_of, rounded};
use crate::app::session::notices::Gravity;
use crate::app::session::session::{Session, Tab};
use crate::app::words::{figure, fill};
use crate::document::figure::{
    Flood, MAX_FLOOD_POINTS, MAX_FLOOD_SEEDS, MAX_REGIONS, Region, Source,
};
use crate::document::{Edit, FigureList, free_group_name};
use glam::Vec2;

impl Session {
    /// The regions that the document lists.
    pub(super) fn listed_regions(&self) -> &[Region] {
        let figure = self.illustration().figure.as_ref();
        figure.map_or(&[], |figure| &figure.regions)
    }

    pub(super) fn region_count(&self) -> usize {
        let own = self.view.figure.regions.iter();
        let listed = self.listed_regions();
        let is_new = |name: &&String| !listed.iter().any(|region| region.name == **name);
        own.map(|region| &region.name).filter(is_new).count() + listed.len()
    }

    /// A name that no region has.
    pub(super) fn free_region_name(&self, wanted: Option<&str>) -> String {
        let own = self.view.figure.regions.iter();
        let listed = self.listed_regions().iter();
        let mut taken: Vec<String> = listed
            .chain(own)
            .map(|region| region.name.clone())
            .collect();
        taken.push("rest".to_owned());
        match wanted {
            Some(wanted) => free_group_name(wanted, &taken),
            None => {
                let mut names = (1..).map(|n: usize| fill(figure::w().region_n, &[&n]));
                names.find(|name| !taken.contains(name)).unwrap_or_default()
            }
        }
    }

    pub(super) fn add_region(&mut self, wanted: Option<&str>, from: &Value) -> bool {
        let limit = fill(figure::w().too_many_regions, &[&MAX_REGIONS]);
        if self.region_count() >= MAX_REGIONS {
            self.notify(Gravity::Info, limit, "");
            return false;
        }
        let name = self.free_region_name(wanted);
        let edit = Edit::AddToFigure {
            list: FigureList::Regions,
            index: usize::MAX,
            entry: json!({ "name": name, "from": from }),
        };
        let is_done = self.apply(&edit, false);
        if is_done {
            self.view.figure.handles.clear();
            self.view.figure.region = Some(name);
            self.side_tab = Tab::Templates;
        }
        is_done
    }

    /// A region of like pixels around a place, or of the shape of a drawing that is seen there.
    pub(super) fn pick_region(&mut self, at: Vec2, adds: bool) {
        let Some((_, at_rest)) = self.at_rest(at) else {
            return self.nothing_here();
        };
        let Some(plate) = self.view.figure.plate.clone() else {
            return;
        };
        if !plate.has_pixels() {
            let Some(shape) = plate.shape_at(at_rest) else {
                return self.nothing_here();
            };
            let regions = self.view.figure.regions.iter();
            let mut own = regions.filter(
                |region| matches!(&region.from, Some(Source::Path(path)) if *path == shape.path),
            );
            match own.next_back() {
                Some(region) => self.view.figure.region = Some(region.name.clone()),
                None => {
                    self.add_region(
                        Some(&shape_name(&shape.path)),
                        &json!({ "path": &shape.path }),
                    );
                }
            }
            return;
        }
        let at = rounded(at_rest.as_dvec2());
        if adds && self.add_seed_to_flood(&at) {
            return;
        }
        self.add_region(None, &json!({ "flood": { "at": [at] } }));
    }

    /// One more point for the flood of the selected region; false if it is none, or has no room.
    pub(super) fn add_seed_to_flood(&mut self, at: &Value) -> bool {
        let figure = self.figure();
        let floods = figure
            .regions
            .iter()
            .filter_map(|region| match &region.from {
                Some(Source::Flood(flood)) => Some(flood.at.len()),
                _ => None,
            });
        if floods.sum::<usize>() >= MAX_FLOOD_POINTS {
            return false;
        }
        let Some((index, seeds)) = self
            .selected_flood()
            .map(|(index, flood)| (index, flood.at.len()))
        else {
            return false;
        };
        let edit = Edit::Set {
            pointer: format!("/figure/regions/{index}/from/flood/at/-"),
            value: at.clone(),
            name: "Change region".to_owned(),
        };
        seeds < MAX_FLOOD_SEEDS && self.apply(&edit, false)
    }

    /// The flood of the selected region, with its place in the document's list.
    pub fn selected_flood(&self) -> Option<(usize, &Flood)> {
        let index = index_of(self, self.view.figure.region.as_deref()?)?;
        match &self.listed_regions().get(index)?.from {
            Some(Source::Flood(flood)) => Some((index, flood)),
            _ => None,
        }
    }

    pub(super) fn widen(&mut self, tolerance: f64) {
        let Some((index, flood)) = self.selected_flood() else {
            return;
        };
        let tolerance = tolerance.round().clamp(0.0, 255.0);
        if flood.tolerance == tolerance {
            return;
        }
        let edit = Edit::Set {
            pointer: format!("/figure/regions/{index}/from/flood/tolerance"),
            value: json!(tolerance),
            name: "Change region".to_owned(),
        };
        self.apply(&edit, true);
    }

    pub(super) fn take_shapes(&mut self) {
        let Some(plate) = self.view.figure.plate.clone() else {
            return;
        };
        let is_taken = |path: &str| {
            let mut regions = self.view.figure.regions.iter();
            regions.any(|region| matches!(&region.from, Some(Source::Path(own)) if own == path))
        };
        let shapes = plate.shapes.iter().filter(|shape| !is_taken(&shape.path));
        let left = MAX_REGIONS.saturating_sub(self.region_count());
        let paths: Vec<&str> = shapes.map(|shape| shape.path.as_str()).collect();
        let mut names: Vec<String> = Vec::new();
        let mut edits = Vec::new();
        for path in paths.iter().take(left) {
            let wanted = shape_name(path);
            let free = self.free_region_name(Some(&wanted));
            let name = match names.contains(&free) {
                true => free_group_name(&free, &names),
                false => free,
            };
            edits.push(Edit::AddToFigure {
                list: FigureList::Regions,
                index: usize::MAX,
                entry: json!({ "name": &name, "from": { "path": path } }),
            });
            names.push(name);
        }
        if paths.len() > left {
            let limit = fill(figure::w().too_many_regions, &[&MAX_REGIONS]);
            self.notify(Gravity::Info, limit, "");
        }
        let edit = Edit::All {
            name: "Take all shapes".to_owned(),
            edits,
        };
        self.apply(&edit, false);
    }
}

/// What a region of a shape is called: by its id, or by its number.
fn shape_name(path: &str) -> String {
    match path.bytes().all(|letter| letter.is_ascii_digit()) {
        true => fill(figure::w().shape_n, &[&path]),
        false => path.to_owned(),
    }
}
