//! One visit, drawn.

use glam::Vec2;
use serde_json::{Value, json};

use super::stock::Stock;
use super::visit::Visit;
use crate::assets::{BendAnswer, BendRequest, Bending};
use crate::data::{Resources, Sheet};
use crate::describe::{Lang, Measured, Sight, describe};
use crate::document::Illustration;
use crate::math::columns;
use crate::render::{
    Clock, FollowedCaptions, Gpu, Image, Marks, RenderError, Renderer, SIGHT_PX, View,
};

/// Samples per pixel of a picture that is read back.
const SAMPLES: u32 = 4;

/// What became of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Drawn {
    /// There is a picture to be shown, and its captions are known.
    pub has_picture: bool,
    /// Nothing is left to do until something changes.
    pub is_done: bool,
}

/// A visit with the renderer of its picture.
pub struct Picture {
    /// What is seen.
    pub visit: Visit,
    renderer: Renderer,
    captions: FollowedCaptions,
    /// What the picture shows, with its camera.
    seen: Option<Box<Illustration>>,
    /// Revisions of the visit and of the stock that the renderer was given.
    given: (u64, u64),
    /// The figure, where the subject is one.
    bending: Bending,
    /// What was said of the figure.
    troubles: Vec<String>,
    size_px: [u32; 2],
    is_complete: bool,
}

impl Picture {
    /// Nothing is drawn before [`Picture::draw`].
    pub fn new(gpu: Gpu, clock: Clock, visit: Visit) -> Self {
        Self {
            visit,
            renderer: Renderer::new(gpu, clock),
            captions: FollowedCaptions::default(),
            seen: None,
            given: (0, 0),
            bending: Bending::default(),
            troubles: Vec::new(),
            size_px: [0, 0],
            is_complete: false,
        }
    }

    /// What the bender of the figure should be asked next, and counts as under way from now on.
    pub fn next_bend(&mut self, stock: &Stock) -> Option<BendRequest> {
        let plate = stock.plate();
        if plate.is_some() {
            self.visit.tell_figure();
        } else if stock.is_in_space() {
            self.visit.tell_space();
        }
        let (visit, bending) = (&self.visit, &mut self.bending);
        bending.next(plate, visit.shown().figure.as_ref(), visit.is_moving())
    }

    /// Takes the answer of the bender.
    pub fn take_bent(&mut self, answer: BendAnswer) {
        self.bending.take(answer);
        self.troubles.extend(self.bending.take_notices());
    }

    /// True if a drawing is seen closer than its pixels, once its picture is complete: what bends it is to be asked for
    /// a finer one then, once.
    pub fn see_closer(&mut self, stock: &Stock) -> bool {
        if !self.is_complete || self.visit.is_moving() || stock.is_finer() {
            return false;
        }
        let camera = self.visit.camera();
        let view = View::new(camera, self.size_px);
        let seen_px = 1.0 / view.units_per_pixel(camera.distance);
        self.bending.see_closer(seen_px)
    }

    /// True while the drawing is being drawn finer.
    pub fn awaits_finer(&self) -> bool {
        self.bending.awaits_aside()
    }

    /// Shows the drawing in more pixels, once it is there: in all pictures of the stock.
    pub fn show_finer(&mut self, stock: &mut Stock) {
        stock.show_finer(&mut self.bending);
    }

    /// True while the figure is not bent as the document has it.
    pub fn is_bending(&self, stock: &Stock) -> bool {
        let figure = self.visit.shown().figure.as_ref();
        self.bending
            .is_behind(stock.plate(), figure, self.visit.is_moving())
    }

    /// What was said of the figure, the newest last.
    pub fn troubles(&self) -> &[String] {
        &self.troubles
    }

    /// True while a frame is drawn whose captions are still being asked for. It is shown with them, so nothing that is
    /// to be drawn should change before.
    pub fn is_asking(&self) -> bool {
        self.captions.is_asking()
    }

    /// One frame's work for a picture of this size, pixels. `budget` is what the GPU may spend on it, seconds.
    ///
    /// # Errors
    /// Those of the renderer; a lost device has to be replaced by [`Picture::recover`].
    pub fn draw(
        &mut self,
        stock: &mut Stock,
        size_px: [u32; 2],
        budget: f32,
        is_moving: bool,
    ) -> Result<Drawn, RenderError> {
        if self.captions.is_asking() {
            self.follow();
            let has_picture = !self.captions.is_asking();
            return Ok(Drawn {
                has_picture,
                is_done: false,
            });
        }
        let stocked = (self.visit.revision(), stock.revision());
        let sheet = self.bending.sheet();
        if self.given != stocked || !Sheet::are_same(self.renderer.sheet(), sheet) {
            self.given = stocked;
            let resources = Resources {
                sheet: sheet.cloned(),
                ..stock.resources(self.visit.shown())
            };
            self.renderer.set_resources(resources);
        }
        self.renderer.share_subject(stock.host());
        let seen = self.seen();
        self.renderer.set_illustration(&seen);
        let state = self.renderer.draw(size_px, budget, is_moving)?;
        if state.is_behind {
            // What the canvas shows stays, with the captions that belong to it.
            self.is_complete = false;
            return Ok(Drawn {
                has_picture: false,
                is_done: state.is_done,
            });
        }
        self.seen = Some(Box::new(seen));
        self.size_px = self.renderer.output_size().unwrap_or(size_px);
        let is_bent = stock.plate().is_none() || self.renderer.sheet().is_some();
        let has_picture = state.has_picture && is_bent && stock.host().subject_info().is_some();
        self.is_complete = has_picture && state.is_done;
        let is_waiting = has_picture && self.follow();
        Ok(Drawn {
            has_picture: has_picture && !self.captions.is_asking(),
            is_done: state.is_done && !is_waiting,
        })
    }

    /// Asks where captions are in the picture that was drawn. True if it has to be asked again soon.
    fn follow(&mut self) -> bool {
        let Some(seen) = &self.seen else {
            return false;
        };
        let about = (&**seen, &seen.camera);
        let is_waiting =
            self.captions
                .update(&mut self.renderer, about, self.size_px, self.is_complete);
        is_waiting || self.captions.is_waiting()
    }

    /// The illustration with the reader's camera.
    fn seen(&self) -> Illustration {
        let mut seen = self.visit.shown().clone();
        seen.camera = *self.visit.camera();
        seen
    }

    /// Width and height of the picture that was drawn, pixels.
    pub fn size_px(&self) -> [u32; 2] {
        self.size_px
    }

    /// The renderer, to show its picture.
    pub fn renderer(&self) -> &Renderer {
        &self.renderer
    }

    /// Where captions go in the picture that was drawn: for each one that is switched on and has a text six numbers:
    /// its index, its state (0: in sight, 1: something lies before its tissue, 2: its tissue was cut away, 3: its
    /// tissue is outside of the frame), the place of its tissue, and the top left corner of its text; those of the
    /// states 2 and 3 have no places. `sizes` has the width and height of each caption's text. Lengths are of the
    /// unit of `area`, the width and height of the picture as it is shown; `gap` lies between texts and around them.
    /// `edges` is kept free for letters at the edges, and `foot` at the lower edge for a scale bar.
    pub fn captions(
        &self,
        area: [f32; 2],
        sizes: &[f32],
        gap: f32,
        [edges, foot]: [f32; 2],
    ) -> Vec<f32> {
        let Some(seen) = &self.seen else {
            return Vec::new();
        };
        let area = Vec2::from(area);
        let view = View::new(&seen.camera, self.size_px);
        let scale = area / view.size_px;
        let mut found = Vec::new();
        let mut absent = Vec::new();
        for ((index, caption), size) in seen
            .captions
            .iter()
            .enumerate()
            .zip(sizes.as_chunks::<2>().0)
        {
            if !caption.is_drawn() {
                continue;
            }
            let Some((place, is_hidden)) = self.captions.place(index) else {
                absent.extend([index as f32, 2.0, 0.0, 0.0, 0.0, 0.0]);
                continue;
            };
            let at = view.pixel_from_subject(place).map(|pixel| pixel * scale);
            match at.filter(|at| at.cmpge(Vec2::ZERO).all() && at.cmple(area).all()) {
                Some(at) => found.push((index, at, is_hidden, Vec2::from(*size))),
                None => absent.extend([index as f32, 3.0, 0.0, 0.0, 0.0, 0.0]),
            }
        }
        let points: Vec<Vec2> = found.iter().map(|found| found.1).collect();
        let sizes: Vec<Vec2> = found.iter().map(|found| found.3).collect();
        let margin = Vec2::splat(gap + edges);
        let below = Vec2::new(margin.x, margin.y.max(gap + foot));
        let room = [margin, area - below];
        let corners = columns::arranged(&points, &sizes, gap, room);
        let rows = found.iter().zip(corners);
        let rows = rows.flat_map(|(&(index, at, is_hidden, _), corner)| {
            let is_hidden = f32::from(u8::from(is_hidden));
            [index as f32, is_hidden, at.x, at.y, corner.x, corner.y]
        });
        rows.chain(absent).collect()
    }

    /// What stands at the picture's edges, as JSON: `bar`, its part of the picture's width and its text, or null;
    /// `sides`, the letters at the left, right, upper and lower edge, or null.
    pub fn marks(&self, mm_per_unit: Option<f64>) -> Value {
        let Some(seen) = &self.seen else {
            return Value::Null;
        };
        let Marks { bar, sides } = Marks::of(seen, self.size_px, mm_per_unit);
        let width = self.size_px[0].max(1) as f32;
        json!({ "bar": bar.map(|bar| json!([bar.length_px / width, bar.text()])), "sides": sides })
    }

    /// The picture in words: what was done, what was kept, from where one looks and, where it has been drawn, what is
    /// in sight. The future owns what it needs.
    pub fn describe(&self, stock: &Stock, lang: Lang) -> impl Future<Output = String> + 'static {
        let document = self.visit.document().clone();
        let step = self.visit.step();
        let segments = match self.bending.sheet() {
            Some(sheet) => sheet.segments(),
            None => stock.host().segments().to_vec(),
        };
        let mm_per_unit = stock.mm_per_unit();
        let turned = Some(self.visit.camera().rotate);
        let sighting = (self.is_complete).then(|| self.renderer.identify(&self.seen(), SIGHT_PX));
        async move {
            let sighting = match sighting {
                Some(sighting) => sighting.await.ok(),
                None => None,
            };
            let measured = Measured {
                sight: sighting.map(|found| Sight::count(found.labels, &segments)),
                mm_per_unit,
                turned,
            };
            let words = describe(&document, step, &measured, lang);
            words.map_or_else(|_| String::new(), |words| words.text().to_owned())
        }
    }

    /// The picture as it stands, drawn once more in full.
    ///
    /// # Errors
    /// [`RenderError::NoSubject`] before there is anything to draw, and those of the renderer.
    pub fn image(&self) -> impl Future<Output = Result<Image, RenderError>> + 'static {
        self.renderer.render_image(
            (&self.seen(), None),
            self.size_px.map(|side| side.max(1)),
            SAMPLES,
            |_| {},
        )
    }

    /// Another stock serves the visit.
    pub fn restock(&mut self) {
        self.given = (0, 0);
    }

    /// Gives back what only this picture holds on the device. It is made anew where the picture is drawn again.
    pub fn destroy(&mut self) {
        (self.given, self.is_complete) = ((0, 0), false);
        self.renderer.destroy_own();
    }

    /// Lets go of the data too; the visit stays as it is.
    pub fn forget_subject(&mut self) {
        (self.given, self.is_complete) = ((0, 0), false);
        self.renderer.forget_shared_subject();
    }

    /// Goes on with another device after the old one was lost.
    ///
    /// # Errors
    /// Those of the renderer.
    pub fn recover(&mut self, gpu: Gpu) -> Result<(), RenderError> {
        self.given = (0, 0);
        self.captions = FollowedCaptions::default();
        self.renderer.recover(gpu)
    }
}
