//! The search for a structure by its name, among tissues and captions, and the turn of the view to it.

use super::camera;
use super::effect::{Effect, Focus};
use super::notices::Gravity;
use super::session::{Session, Tab};
use super::sought::Sought;
use super::tissues::TissueCommand;
use crate::app::words::search::has_words;
use crate::app::words::{fill, in_sentence, kept, tissue};
use crate::data::Site;
use crate::document::Camera;

impl Session {
    /// Puts the keyboard into the search over tissues and captions.
    pub(super) fn start_seeking(&mut self) {
        self.are_panels_hidden = false;
        self.side_tab = Tab::Tissues;
        self.tab = self.are_drawers.then_some(Tab::Tissues);
        self.effect(Effect::Focus(Focus::Tissues));
    }

    /// Tissues and captions whose names have every word of the search, in the order of the panel: recipes, segments of
    /// files, captions. Without a search every tissue.
    pub fn found_by_name(&self) -> Vec<Sought> {
        let wanted = self.tissues.search.trim();
        let recipes = &self.illustration().recipes;
        let facts = self.view.subject.as_ref();
        let listed = facts.map_or(&[][..], |facts| &facts.tissues);
        let is_made = |name: &&String| recipes.iter().any(|recipe| recipe.name == **name);
        let made = recipes.iter().map(|recipe| &recipe.name);
        let tissues = made.chain(listed.iter().filter(|name| !is_made(name)));
        let tissues = tissues
            .filter(|name| has_words(&format!("{name} {}", kept::segment(name)), wanted))
            .map(|name| Sought::Tissue(name.clone()));
        let captions = self.shown().captions.iter().enumerate();
        let captions = captions
            .filter(|(_, caption)| !wanted.is_empty() && has_words(&caption.text, wanted))
            .map(|(index, _)| Sought::Caption(index));
        tissues.chain(captions).collect()
    }

    /// Turns the view to what is sought, as soon as it is known where that lies. A tissue is chosen and shown for a
    /// moment too.
    pub(super) fn seek(&mut self, sought: Sought) {
        if let Sought::Tissue(name) = &sought {
            self.run_tissue(TissueCommand::Select(name.clone()));
        }
        self.effect(Effect::Locate(sought));
    }

    /// Turns the view to the first that the search finds.
    pub(super) fn seek_first(&mut self) {
        if self.tissues.search.trim().is_empty() {
            return;
        }
        if let Some(first) = self.found_by_name().into_iter().next() {
            self.seek(first);
        }
    }

    /// Turns the view to where something lies, and puts the slices through its middle.
    pub(super) fn turn_to(&mut self, sought: &Sought, site: Option<Site>) {
        let Some(site) = site else {
            let name = match sought {
                Sought::Tissue(name) => in_sentence(&kept::segment(name)),
                Sought::Caption(index) => {
                    let caption = self.shown().captions.get(*index);
                    caption.map_or_else(String::new, |caption| caption.text.clone())
                }
            };
            let text = match self.tissues.is_behind {
                true => tissue::w().not_yet,
                false => tissue::w().nowhere,
            };
            let text = fill(text, &[&name]);
            return self.notify(Gravity::Info, text, "");
        };
        self.view.set_cross(site.middle);
        self.glide_to(match self.view.is_figure() {
            true => Camera {
                target: site.centroid,
                ..self.camera
            },
            false => camera::turned_to(&self.camera, &site),
        });
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::super::{Command, Session};
    use super::*;

    const LABELLED: &str = r#"{ "fabrica": 1,
        "subject": { "builtin": "cube", "features": [ { "name": "aorta 2", "from": { "threshold": [1, 2] } } ] },
        "labels": [ { "text": "Vía aérea", "at": [0, -0.3, 0.1] }, { "text": "Arch of the aorta", "at": [0, 0, 0] } ] }"#;

    /// A session with segments of these labels and names.
    fn session(segments: &[(u16, &str)]) -> Session {
        Session::with_scan(LABELLED, 1.0, segments)
    }

    fn search(session: &mut Session, text: &str) -> Vec<String> {
        let command = TissueCommand::Search(text.to_owned());
        session.run(Command::Tissue(command), 0.0);
        let found = session.found_by_name().into_iter();
        let name = |sought| match sought {
            Sought::Tissue(name) => name,
            Sought::Caption(index) => format!("#{index}"),
        };
        found.map(name).collect()
    }

    /// Runs a command and gives back what is to be located.
    fn located(session: &mut Session, command: Command) -> Option<Sought> {
        let mut effects = session.run(command, 0.0).into_iter();
        let located = effects.next().map(|effect| match effect {
            Effect::Locate(sought) => sought,
            other => panic!("{other:?}"),
        });
        assert!(effects.next().is_none(), "one effect at most");
        located
    }

    #[test]
    fn tissues_and_captions_are_found_by_their_names() {
        // Labels 2 and 3 overlap under 4.
        let all = [
            (1, "bone"),
            (2, "Aorta"),
            (3, "airway"),
            (4, "Aorta"),
            (4, "airway"),
        ];
        let mut session = session(&all);
        let every = ["aorta 2", "bone", "Aorta", "airway"];
        assert_eq!(search(&mut session, "  "), every, "each tissue once");
        assert_eq!(search(&mut session, "AÓRTA"), ["aorta 2", "Aorta", "#1"]);
        assert_eq!(search(&mut session, "via aerea"), ["#0"]);
        assert_eq!(search(&mut session, "aorta arch"), ["#1"], "every word");
        assert_eq!(search(&mut session, "spleen"), [""; 0]);
        assert_eq!(located(&mut session, Command::SeekFirst), None);
        search(&mut session, "");
        assert_eq!(located(&mut session, Command::SeekFirst), None);
        search(&mut session, "air");
        session.run(Command::Escape, 0.0);
        assert_eq!(session.tissues.search, "", "Escape ends the search");
    }

    #[test]
    fn what_is_found_is_shown_and_turned_to() {
        let mut session = session(&[(1, "bone"), (2, "Aorta")]);
        search(&mut session, "bon");
        let sought = located(&mut session, Command::SeekFirst).expect("bone");
        assert_eq!(sought, Sought::Tissue("bone".to_owned()));
        assert_eq!(session.tissues.selected.as_deref(), Some("bone"));
        assert!(session.tissues.glimpse.is_some(), "for a moment");
        let document = session.document().to_json();
        let site = Site {
            middle: Vec3::new(0.0, -0.25, 0.0),
            centroid: Vec3::new(0.0, -0.3, 0.0),
            reach: 0.1,
        };
        let before = session.camera;
        session.run(Command::TurnTo(sought, Some(site)), 0.0);
        assert_eq!(session.view.cross, site.middle, "slices go through it");
        assert_eq!(session.camera, before, "it glides");
        assert!(session.advance(0.15) && session.camera != before);
        session.advance(1.0);
        let back = camera::axes(session.camera.rotate)[2];
        assert!(back.distance(Vec3::NEG_Y) < 1e-3, "from behind: {back}");
        assert_eq!(session.document().to_json(), document, "the look only");
        // A caption is turned to; no tissue is shown for it.
        session.take_effects();
        session.tissues.glimpse = None;
        let caption = Sought::Caption(0);
        let asked = located(&mut session, Command::Seek(caption.clone()));
        assert_eq!(asked, Some(caption));
        assert_eq!(session.tissues.glimpse, None);
    }

    #[test]
    fn what_is_nowhere_is_said() {
        let mut session = session(&[(1, "bone")]);
        let camera = session.camera;
        let bone = Sought::Tissue("bone".to_owned());
        session.run(Command::TurnTo(bone.clone(), None), 0.0);
        let said = |session: &Session| {
            let last = session.notices.all().last().map(|n| n.message.clone());
            last.expect("a message")
        };
        assert_eq!(said(&session), "There is no bone in this scan");
        session.tissues.is_behind = true;
        session.run(Command::TurnTo(bone, None), 0.0);
        assert_eq!(said(&session), "Still being found: bone");
        assert!(!session.advance(1.0) && session.camera == camera);
    }

    #[test]
    fn the_search_has_the_keyboard_in_its_panel() {
        let mut session = session(&[]);
        session.are_panels_hidden = true;
        let effects = session.run(Command::StartSeeking, 0.0);
        assert!(matches!(effects[..], [Effect::Focus(Focus::Tissues)]));
        assert_eq!((session.side_tab, session.tab), (Tab::Tissues, None));
        assert!(!session.are_panels_hidden);
        session.are_drawers = true;
        session.run(Command::StartSeeking, 0.0);
        assert_eq!(session.tab, Some(Tab::Tissues), "a drawer on a phone");
    }
}
