use super::mesh::Mesh;
use super::notice::Notice;
use super::plane::Plane;
use super::progress::Progress;
use super::regions::{Canvas, Mask};
use super::svg::{Drawing, MAX_DRAWN_SIDE, SvgError};
use crate::data::{Plate, PlateOrigin};
use crate::document::figure::{Figure, Region, Source};
use crate::pictures::Picture;

/// What a figure is made of: the pixels or the shapes that its regions are found in. Built once for a plate.
#[derive(Clone, Debug)]
pub struct Original {
    /// How the figure's plane lies over the map.
    pub plane: Plane,
    /// The shapes of a drawing; none of a picture.
    pub drawing: Option<Drawing>,
    picture: Picture,
    /// Regions that a drawing of the program comes with.
    regions: Vec<Region>,
    /// What of a drawing's map is not transparent.
    drawn: Option<Mask>,
}

impl Original {
    /// That of a plate.
    ///
    /// # Errors
    /// [`SvgError`] where the plate is a drawing that cannot be read.
    pub fn of(plate: &Plate) -> Result<Self, SvgError> {
        let (drawing, regions) = match &plate.origin {
            PlateOrigin::Pixels => (None, Vec::new()),
            PlateOrigin::Drawing(bytes) => (Some(Drawing::read(bytes)?), Vec::new()),
            PlateOrigin::Builtin(name) => {
                let drawn = super::drawn::drawn(name).ok_or(SvgError::NoSvg)?;
                (Some(Drawing::read(drawn.svg.as_bytes())?), drawn.regions)
            }
        };
        let plane = match &drawing {
            Some(drawing) => Plane::of_drawing(drawing.size),
            None => Plane {
                source: plate.size,
                map: plate.picture.size,
            },
        };
        Ok(Self {
            drawn: drawing.as_ref().map(|drawing| drawing.drawn(&plane)),
            plane,
            drawing,
            picture: plate.picture.clone(),
            regions,
        })
    }

    /// The picture that a figure is drawn from.
    pub fn picture(&self) -> &Picture {
        &self.picture
    }

    /// A drawing drawn finer, for where it is seen closer than its pixels; `None` for a picture, which has no more.
    pub fn finer(&self) -> Option<Picture> {
        self.drawing.as_ref()?.picture(MAX_DRAWN_SIDE).ok()
    }

    /// A document's figure with what it leaves to the source: regions of a drawing of the program, and regions that
    /// take the shapes of their name.
    pub fn completed(&self, figure: &Figure) -> Figure {
        let mut whole = figure.clone();
        whole.regions = self.regions.clone();
        for region in &figure.regions {
            let own = whole.regions.iter_mut().find(|own| own.name == region.name);
            match own {
                Some(own) => *own = region.over(own),
                None => whole.regions.push(region.clone()),
            }
        }
        if let Some(drawing) = &self.drawing {
            for region in whole
                .regions
                .iter_mut()
                .filter(|region| region.from.is_none())
            {
                let has_shapes = !drawing.taken(&region.name).is_empty();
                region.from = has_shapes.then(|| Source::Path(region.name.clone()));
            }
        }
        whole
    }

    /// The mesh of a figure that [`Original::completed`] gave; none if `progress` has stopped it.
    pub fn mesh(
        &self,
        figure: &Figure,
        notices: &mut Vec<Notice>,
        progress: &mut Progress<'_>,
    ) -> Option<Mesh> {
        let fills = |path: &str| self.drawing.as_ref()?.fills(&self.plane, path);
        let canvas = Canvas {
            plane: self.plane,
            picture: self.drawing.is_none().then_some(&self.picture),
            drawn: self.drawn.clone(),
            shapes: &fills,
        };
        Mesh::new(&canvas, figure, notices, progress)
    }
}
