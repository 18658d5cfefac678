//! What to ask of whoever bends figures: that takes up to a second, so it is done in a thread or a worker, which may be
//! behind what is to be shown.

use std::sync::Arc;

use crate::data::{Plate, Sheet};
use crate::document::figure::{Figure, Region};
use crate::pictures::Picture;

/// Rounds by which a pose follows while something moves: more would hold up the next one.
pub const FOLLOWING: u32 = 4;

/// Seconds in which a figure that followed a hand or a passage comes to the pose at rest.
const EASING: f64 = 0.2;

/// Seconds after which it is told how much is done: most poses are there before.
const PATIENCE: f64 = 0.4;

/// What is said of one plate at most: poses of a lesson that plays for hours may differ in their notices.
const MOST_TOLD: usize = 50;

/// What a bender is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct BendRequest {
    /// The plate that is bent from now on; `None`: that of the request before.
    pub plate: Option<Arc<Plate>>,
    /// How it is divided and bent.
    pub figure: Figure,
    /// How far its turns are found.
    pub pose: BendPose,
}

/// How far the turns of a pose are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BendPose {
    /// To the end.
    AtRest,
    /// With so many rounds from the last pose on.
    Following(u32),
    /// To the end, but what follows goes on from the pose before.
    Aside,
    /// Not at all: the drawing itself is drawn finer.
    Finer,
}

/// What a bender answers.
#[derive(Clone, Debug, PartialEq)]
pub enum BendAnswer {
    /// The figure as it is bent.
    Bent {
        /// What is drawn. Its mesh is that of the answer before unless regions have changed.
        sheet: Sheet,
        /// The figure's regions with what its source adds, from behind to front; `None`: those of the answer before.
        regions: Option<Vec<Region>>,
        /// What should be said of the pose at rest.
        notices: Vec<String>,
    },
    /// The drawing in more pixels.
    Finer(Picture),
    /// So much of it is done, 0 to 1. The answer itself follows.
    UnderWay(f32),
    /// It was stopped, and the bender is gone, with the plate that it had.
    Stopped,
    /// There is none, and why.
    Failed(String),
    /// The bender is gone, with the plate that it had, and why.
    Lost(String),
}

/// A pose that was asked for.
#[derive(Clone, Debug, PartialEq)]
struct Asked {
    figure: Figure,
    is_at_rest: bool,
    /// It is for somebody else than the picture.
    is_aside: bool,
}

/// A figure on its way from the pose that followed to that at rest.
#[derive(Clone, Debug)]
struct Easing {
    from: Sheet,
    /// When it was first shown, seconds.
    since: Option<f64>,
}

/// How much of what is under way is done.
#[derive(Clone, Copy, Debug)]
struct Progress {
    /// 0 to 1.
    part: f32,
    /// When it was first asked for, seconds.
    since: Option<f64>,
}

/// The figure of one picture: what is asked of its bender, and the newest sheet. At most one request is under way; what
/// is wanted when its answer comes is asked for next, so that of several wishes only the newest is granted.
#[derive(Debug, Default)]
pub struct Bending {
    /// The plate that is shown.
    plate: Option<Arc<Plate>>,
    /// The bender has it.
    has_plate: bool,
    under_way: Option<Asked>,
    /// The answer under way is of a plate that nobody wants any more.
    is_outdated: bool,
    /// What the sheet shows.
    shown: Option<Asked>,
    sheet: Option<Sheet>,
    easing: Option<Easing>,
    /// What is wanted besides, when the sheet is what is wanted.
    wish: Option<Figure>,
    /// What was bent besides; no sheet if it could not be.
    aside: Option<(Figure, Option<Sheet>)>,
    /// The drawing is seen closer than its pixels.
    is_coarse: bool,
    /// It was asked for in more pixels.
    is_finer_asked: bool,
    finer: Option<Picture>,
    progress: Option<Progress>,
    is_stopped: bool,
    regions: Arc<Vec<Region>>,
    notices: Vec<String>,
    /// What was said of poses at rest before: it is not said again.
    told: Vec<String>,
    failure: Option<String>,
}

impl Bending {
    /// What should be asked next, and counts as under way from now on: the pose that follows while something moves,
    /// else that at rest. `None` while an answer is awaited, and where the sheet is what is wanted. Without a plate
    /// everything is forgotten.
    pub fn next(
        &mut self,
        plate: Option<&Arc<Plate>>,
        figure: Option<&Figure>,
        is_moving: bool,
    ) -> Option<BendRequest> {
        let Some(plate) = plate else {
            self.forget();
            return None;
        };
        let is_same = |known: &Arc<Plate>| Arc::ptr_eq(known, plate);
        if !self.plate.as_ref().is_some_and(is_same) {
            self.forget();
            self.plate = Some(Arc::clone(plate));
        }
        if self.under_way.is_some() {
            return None;
        }
        if !self.wants(figure, is_moving) {
            if self.is_coarse && !std::mem::replace(&mut self.is_finer_asked, true) {
                return Some(self.request(Figure::default(), BendPose::Finer));
            }
            let figure = self.wish.take()?;
            return Some(self.request(figure, BendPose::Aside));
        }
        self.is_stopped = false;
        // There is nothing to follow before the first pose.
        let pose = match !is_moving || self.sheet.is_none() {
            true => BendPose::AtRest,
            false => BendPose::Following(FOLLOWING),
        };
        Some(self.request(figure.cloned().unwrap_or_default(), pose))
    }

    fn request(&mut self, figure: Figure, pose: BendPose) -> BendRequest {
        let has_plate = std::mem::replace(&mut self.has_plate, true);
        self.under_way = Some(Asked {
            figure: figure.clone(),
            is_at_rest: !matches!(pose, BendPose::Following(_)),
            is_aside: matches!(pose, BendPose::Aside | BendPose::Finer),
        });
        BendRequest {
            plate: self.plate.clone().filter(|_| !has_plate),
            figure,
            pose,
        }
    }

    fn forget(&mut self) {
        let is_outdated = self.under_way.is_some();
        *self = Self {
            under_way: self.under_way.take(),
            is_outdated,
            ..Self::default()
        };
    }

    /// True if the sheet is not what is wanted.
    fn wants(&self, figure: Option<&Figure>, is_moving: bool) -> bool {
        let Some(shown) = &self.shown else {
            return true;
        };
        let is_it = match figure {
            Some(figure) => shown.figure == *figure,
            None => shown.figure == Figure::default(),
        };
        !is_it || !(shown.is_at_rest || is_moving)
    }

    /// Takes the answer to the request under way.
    pub fn take(&mut self, answer: BendAnswer) {
        if let BendAnswer::UnderWay(part) = answer {
            let since = self.progress.and_then(|progress| progress.since);
            let of_picture = self.under_way.as_ref().filter(|asked| !asked.is_aside);
            self.progress = of_picture.map(|_| Progress { part, since });
            return;
        }
        self.progress = None;
        let mut asked = self.under_way.take();
        self.has_plate &= !matches!(answer, BendAnswer::Lost(_) | BendAnswer::Stopped);
        if std::mem::take(&mut self.is_outdated) {
            return;
        }
        if let Some(asked) = asked.take_if(|asked| asked.is_aside) {
            let sheet = match answer {
                BendAnswer::Bent { sheet, .. } => Some(sheet),
                BendAnswer::Finer(picture) => {
                    self.finer = Some(picture);
                    return;
                }
                _ => None,
            };
            self.aside = Some((asked.figure, sheet));
            return;
        }
        let is_at_rest = asked.as_ref().is_some_and(|asked| asked.is_at_rest);
        let before = std::mem::replace(&mut self.shown, asked);
        match answer {
            BendAnswer::Bent {
                sheet,
                regions,
                notices,
            } => {
                let followed = before.as_ref().is_some_and(|asked| !asked.is_at_rest);
                let old = self.sheet.take().filter(|_| followed && is_at_rest);
                self.easing = old.map(|from| Easing { from, since: None });
                self.sheet = Some(sheet);
                if let Some(regions) = regions {
                    self.regions = Arc::new(regions);
                }
                self.failure = None;
                for notice in notices {
                    if is_at_rest && self.told.len() < MOST_TOLD && !self.told.contains(&notice) {
                        self.notices.push(notice.clone());
                        self.told.push(notice);
                    }
                }
            }
            BendAnswer::UnderWay(_) | BendAnswer::Finer(_) => {}
            BendAnswer::Stopped => self.is_stopped = true,
            BendAnswer::Failed(why) | BendAnswer::Lost(why) => {
                if self.failure.as_ref() != Some(&why) {
                    self.notices.push(why.clone());
                }
                self.failure = Some(why);
            }
        }
    }

    /// The sheet of another pose of the same figure at rest, besides the one that is shown: `None` until it is there,
    /// and nothing within if it could not be bent. Whoever wants it asks again and again.
    pub fn aside(&mut self, figure: &Figure) -> Option<Option<Sheet>> {
        if self.aside.as_ref().is_some_and(|(of, _)| of == figure) {
            return self.aside.take().map(|(_, sheet)| sheet);
        }
        let is_it = |asked: &Asked| asked.is_aside && asked.figure == *figure;
        let is_under_way = self.under_way.as_ref().is_some_and(is_it);
        self.wish = (!is_under_way).then(|| figure.clone());
        None
    }

    /// The plate is seen at rest with its longest side so long, pixels: a drawing with fewer is drawn finer, once. True
    /// if that is to be asked for next.
    pub fn see_closer(&mut self, seen_px: f32) -> bool {
        let plate = self.plate.as_ref();
        self.is_coarse = plate.is_some_and(|plate| plate.is_coarse(seen_px));
        self.is_coarse && !self.is_finer_asked
    }

    /// True while something is done that the picture does not wait for: another pose, or a finer drawing.
    pub fn awaits_aside(&self) -> bool {
        let under_way = self.under_way.as_ref();
        under_way.is_some_and(|asked| asked.is_aside)
    }

    /// The drawing in more pixels, once it is there.
    pub fn take_finer(&mut self) -> Option<Picture> {
        self.finer.take()
    }

    /// The newest sheet.
    pub fn sheet(&self) -> Option<&Sheet> {
        self.sheet.as_ref()
    }

    /// The sheet as it is to be seen at a time, seconds: on its way to the pose at rest where it followed something.
    pub fn eased(&mut self, now: f64) -> Option<Sheet> {
        let sheet = self.sheet.clone()?;
        let Some(easing) = &mut self.easing else {
            return Some(sheet);
        };
        let since = *easing.since.get_or_insert(now);
        let part = ((now - since) / EASING) as f32;
        let is_one = Arc::ptr_eq(&easing.from.mesh, &sheet.mesh);
        if !(0.0..1.0).contains(&part) || !is_one {
            self.easing = None;
            return Some(sheet);
        }
        let pairs = easing.from.places.iter().zip(&*sheet.places);
        let places = pairs.map(|(from, to)| from.lerp(*to, part)).collect();
        Some(Sheet {
            places: Arc::new(places),
            ..sheet
        })
    }

    /// The sheet is that of the pose at rest at once.
    pub fn end_easing(&mut self) {
        self.easing = None;
    }

    /// True while the sheet is on its way to the pose at rest.
    pub fn is_easing(&self) -> bool {
        self.easing.is_some()
    }

    /// How much of the pose that is awaited is done, 0 to 1, once that has taken a while. The time is in seconds.
    pub fn progress(&mut self, now: f64) -> Option<f32> {
        let progress = self.progress.as_mut()?;
        let since = *progress.since.get_or_insert(now);
        (now - since >= PATIENCE).then_some(progress.part)
    }

    /// True if the pose that was asked for was stopped, and no other has been since.
    pub fn is_stopped(&self) -> bool {
        self.is_stopped
    }

    /// The pose that was stopped is asked for again.
    pub fn go_on(&mut self) {
        if std::mem::take(&mut self.is_stopped) {
            self.shown = None;
        }
    }

    /// The figure's regions with what its source adds, from behind to front, as of the last pose at rest.
    pub fn regions(&self) -> &Arc<Vec<Region>> {
        &self.regions
    }

    /// True if the plate has to be bent before the picture is what the document says.
    pub fn is_behind(
        &self,
        plate: Option<&Arc<Plate>>,
        figure: Option<&Figure>,
        is_moving: bool,
    ) -> bool {
        let Some(plate) = plate else {
            return false;
        };
        let is_same = |known: &Arc<Plate>| Arc::ptr_eq(known, plate);
        let is_new = !self.plate.as_ref().is_some_and(is_same);
        let is_of_picture = |asked: &Asked| !asked.is_aside;
        is_new
            || self.under_way.as_ref().is_some_and(is_of_picture)
            || self.wants(figure, is_moving)
    }

    /// What should be said of the figure; each is returned once.
    pub fn take_notices(&mut self) -> Vec<String> {
        std::mem::take(&mut self.notices)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::{PlateOrigin, SheetMesh};
    use glam::DVec2;

    fn plate() -> Arc<Plate> {
        Arc::new(Plate {
            size: DVec2::ONE,
            picture: Picture {
                size: [1, 1],
                pixels: vec![[0; 4]],
                is_of_inks: false,
            },
            origin: PlateOrigin::Pixels,
            shapes: Vec::new(),
            words: Vec::new(),
        })
    }

    fn figure(detail: u32) -> Figure {
        Figure {
            detail,
            ..Figure::default()
        }
    }

    fn bent(notices: &[&str]) -> BendAnswer {
        BendAnswer::Bent {
            sheet: Sheet {
                mesh: Arc::new(SheetMesh::default()),
                places: Arc::default(),
                order: Arc::default(),
                base: None,
            },
            regions: None,
            notices: notices.iter().map(|&notice| notice.to_owned()).collect(),
        }
    }

    #[test]
    fn one_is_under_way_and_the_newest_is_next() {
        let (plate, mut bending) = (plate(), Bending::default());
        let first = bending.next(Some(&plate), None, false).expect("it is new");
        assert!(first.plate.is_some() && first.pose == BendPose::AtRest);
        for detail in [600, 700, 800] {
            let next = bending.next(Some(&plate), Some(&figure(detail)), true);
            assert_eq!(next, None, "one is under way");
        }
        bending.take(bent(&[]));
        let next = bending.next(Some(&plate), Some(&figure(800)), true);
        let next = next.expect("another figure");
        assert_eq!(
            (next.plate, next.pose),
            (None, BendPose::Following(FOLLOWING))
        );
        assert_eq!(next.figure, figure(800));
        bending.take(bent(&[]));
        assert_eq!(bending.next(Some(&plate), Some(&figure(800)), true), None);
        let at_rest = bending.next(Some(&plate), Some(&figure(800)), false);
        assert_eq!(at_rest.expect("it stands still").pose, BendPose::AtRest);
        assert!(bending.is_behind(Some(&plate), Some(&figure(800)), false));
        bending.take(bent(&[]));
        assert_eq!(bending.next(Some(&plate), Some(&figure(800)), false), None);
        assert!(!bending.is_behind(Some(&plate), Some(&figure(800)), false));
    }

    #[test]
    fn another_pose_is_bent_besides() {
        let (plate, mut bending) = (plate(), Bending::default());
        let asks = |bending: &mut Bending, detail| {
            let request = bending.next(Some(&plate), Some(&figure(detail)), false);
            request.map(|request| (request.figure.detail, request.pose))
        };
        assert_eq!(bending.aside(&figure(900)), None);
        assert_eq!(asks(&mut bending, 600), Some((600, BendPose::AtRest)));
        assert_eq!(bending.aside(&figure(900)), None);
        assert_eq!(asks(&mut bending, 600), None, "one is under way");
        bending.take(bent(&["of the picture"]));
        assert_eq!(asks(&mut bending, 600), Some((900, BendPose::Aside)));
        assert!(!bending.is_behind(Some(&plate), Some(&figure(600)), false));
        assert_eq!(bending.aside(&figure(900)), None);
        bending.take(BendAnswer::UnderWay(0.5));
        assert_eq!(bending.progress(1.0).or(bending.progress(9.0)), None);
        assert_eq!(bending.take_notices(), ["of the picture"]);
        bending.take(bent(&["of the other"]));
        assert!(bending.take_notices().is_empty());
        assert_eq!(asks(&mut bending, 600), None, "asked for once");
        assert!(
            bending
                .aside(&figure(900))
                .is_some_and(|sheet| sheet.is_some())
        );
        assert_eq!(asks(&mut bending, 600), None);
        // The picture comes first.
        assert_eq!(bending.aside(&figure(900)), None);
        assert_eq!(asks(&mut bending, 700), Some((700, BendPose::AtRest)));
        bending.take(bent(&[]));
        assert_eq!(asks(&mut bending, 700), Some((900, BendPose::Aside)));
        bending.take(BendAnswer::Lost("gone".to_owned()));
        assert_eq!(bending.aside(&figure(900)), Some(None));
        let next = bending.next(Some(&plate), Some(&figure(800)), false);
        assert!(next.is_some_and(|request| request.plate.is_some()));
    }

    #[test]
    fn a_drawing_is_drawn_finer_once() {
        let drawing = |origin| {
            Arc::new(Plate {
                origin,
                ..(*plate()).clone()
            })
        };
        let mut bending = Bending::default();
        for origin in [
            PlateOrigin::Pixels,
            PlateOrigin::Builtin("drawn-arm".to_owned()),
        ] {
            let is_drawing = origin != PlateOrigin::Pixels;
            let plate = drawing(origin);
            assert!(bending.next(Some(&plate), None, false).is_some());
            bending.take(bent(&[]));
            let asks = |bending: &mut Bending| bending.next(Some(&plate), None, false);
            assert!(!bending.see_closer(1.0));
            assert_eq!(asks(&mut bending), None, "it is fine enough");
            assert_eq!(bending.see_closer(1.5), is_drawing);
            let asked = asks(&mut bending).map(|request| request.pose);
            assert_eq!(asked, is_drawing.then_some(BendPose::Finer));
            assert_eq!(bending.awaits_aside(), is_drawing);
            if is_drawing {
                assert!(!bending.is_behind(Some(&plate), None, false));
                bending.take(BendAnswer::Finer(plate.picture.clone()));
                assert_eq!(bending.take_finer(), Some(plate.picture.clone()));
            }
            assert!(bending.take_finer().is_none() && bending.sheet().is_some());
            assert!(!bending.awaits_aside());
            assert!(!bending.see_closer(1.5), "once");
            assert_eq!(asks(&mut bending), None, "once");
        }
    }

    #[test]
    fn an_answer_about_another_plate_is_dropped() {
        let (old, new, mut bending) = (plate(), plate(), Bending::default());
        assert!(bending.next(Some(&old), None, false).is_some());
        assert_eq!(bending.next(Some(&new), None, false), None, "under way");
        assert!(bending.is_behind(Some(&new), None, false));
        bending.take(bent(&["of the old one"]));
        assert!(bending.sheet().is_none() && bending.take_notices().is_empty());
        let next = bending.next(Some(&new), None, false).expect("it is new");
        assert!(next.plate.is_some_and(|plate| Arc::ptr_eq(&plate, &new)));
        bending.take(bent(&[]));
        assert!(bending.sheet().is_some());
        // A subject of another kind: nothing is bent, and nothing is kept.
        assert_eq!(bending.next(None, None, false), None);
        assert!(bending.sheet().is_none() && !bending.is_behind(None, None, false));
    }

    #[test]
    fn notices_and_failures_are_told_once() {
        let (plate, mut bending) = (plate(), Bending::default());
        let ask = |bending: &mut Bending, detail, answer| {
            assert!(
                bending
                    .next(Some(&plate), Some(&figure(detail)), false)
                    .is_some()
            );
            bending.take(answer);
            bending.take_notices()
        };
        assert_eq!(ask(&mut bending, 600, bent(&["a"])), ["a"]);
        assert!(ask(&mut bending, 700, bent(&["a"])).is_empty());
        assert_eq!(ask(&mut bending, 800, bent(&["a", "b"])), ["b"]);
        let failed = || BendAnswer::Failed("no".to_owned());
        assert_eq!(ask(&mut bending, 900, failed()), ["no"]);
        assert!(ask(&mut bending, 1000, failed()).is_empty());
        assert!(bending.sheet().is_some(), "the last one stays");
        // A bender that is gone is not asked for the same again; the next one gets the plate.
        let lost = BendAnswer::Lost("gone".to_owned());
        assert_eq!(ask(&mut bending, 1100, lost), ["gone"]);
        assert_eq!(bending.next(Some(&plate), Some(&figure(1100)), false), None);
        let again = bending.next(Some(&plate), Some(&figure(1200)), false);
        assert!(again.is_some_and(|request| request.plate.is_some()));
    }

    #[test]
    fn what_takes_long_tells_of_it_and_can_be_stopped() {
        let (plate, mut bending) = (plate(), Bending::default());
        let asks = |bending: &mut Bending, detail| {
            let request = bending.next(Some(&plate), Some(&figure(detail)), false);
            request.map(|request| request.plate.is_some())
        };
        assert_eq!(asks(&mut bending, 600), Some(true));
        assert_eq!(bending.progress(1.0), None, "nothing is known of it");
        bending.take(BendAnswer::UnderWay(0.25));
        assert_eq!(bending.progress(1.0), None, "it may be there at once");
        bending.take(BendAnswer::UnderWay(0.5));
        assert_eq!(bending.progress(1.1), None);
        assert_eq!(bending.progress(1.5), Some(0.5));
        assert_eq!(asks(&mut bending, 700), None, "one is under way");
        bending.take(bent(&[]));
        assert_eq!(bending.progress(9.0), None);
        assert_eq!(asks(&mut bending, 700), Some(false));
        bending.take(BendAnswer::Stopped);
        assert!(
            bending.is_stopped() && bending.sheet().is_some(),
            "the last one stays"
        );
        assert_eq!(asks(&mut bending, 700), None, "it was stopped");
        bending.go_on();
        assert_eq!(asks(&mut bending, 700), Some(true), "to another bender");
        bending.take(bent(&[]));
        assert!(!bending.is_stopped());
        // Another figure is another matter.
        assert_eq!(asks(&mut bending, 800), Some(false));
        bending.take(BendAnswer::Stopped);
        assert_eq!(asks(&mut bending, 900), Some(true));
        assert!(!bending.is_stopped());
        // What is told too late says nothing.
        bending.take(bent(&[]));
        bending.take(BendAnswer::UnderWay(0.5));
        assert_eq!(bending.progress(9.0), None);
        assert_eq!(bending.progress(10.0), None);
    }

    #[test]
    fn what_followed_comes_to_rest_in_a_while() {
        let at = |x: f32, mesh: &Arc<SheetMesh>| BendAnswer::Bent {
            sheet: Sheet {
                mesh: Arc::clone(mesh),
                places: Arc::new(vec![glam::Vec2::X * x]),
                order: Arc::default(),
                base: None,
            },
            regions: None,
            notices: Vec::new(),
        };
        let (plate, mesh, mut bending) = (plate(), Arc::default(), Bending::default());
        let ask = |bending: &mut Bending, detail, is_moving, x, mesh: &Arc<SheetMesh>| {
            let asked = bending.next(Some(&plate), Some(&figure(detail)), is_moving);
            assert!(asked.is_some(), "{detail}");
            bending.take(at(x, mesh));
        };
        let x = |bending: &mut Bending, now| bending.eased(now).expect("a sheet").places[0].x;
        ask(&mut bending, 600, false, 0.0, &mesh);
        assert!(!bending.is_easing(), "nothing was followed");
        ask(&mut bending, 700, true, 1.0, &mesh);
        assert_eq!(x(&mut bending, 3.0), 1.0, "it follows at once");
        ask(&mut bending, 700, false, 2.0, &mesh);
        assert_eq!(x(&mut bending, 5.0), 1.0);
        assert!((x(&mut bending, 5.1) - 1.5).abs() < 1e-4 && bending.is_easing());
        assert_eq!(x(&mut bending, 5.2), 2.0);
        assert!(!bending.is_easing());
        // Another mesh has other vertices.
        ask(&mut bending, 800, true, 1.0, &mesh);
        ask(&mut bending, 800, false, 2.0, &Arc::default());
        assert_eq!(x(&mut bending, 6.0), 2.0);
    }
}
