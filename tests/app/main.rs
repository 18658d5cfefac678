//! The app by role and label.

mod assets;
mod authoring;
mod bodies;
mod canvas;
mod captions;
mod clay;
mod comfort;
mod dropping;
mod figures;
mod library;
mod looking;
mod making;
mod objects;
mod opening;
mod screens;
#[path = "../support/segment_files.rs"]
mod segment_files;
mod share;
mod steps;
mod style;
mod tissue;
mod window;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

use egui::{Key, Modifiers, Pos2, Role, Vec2, pos2, vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use egui_kittest::{Harness, wgpu::WgpuTestRenderer};
use fabrica::app::{
    App, LinkChange, LoadEvent, Message, MissingDocument, RawQuestion, SaveFile, SavedTo, Services,
    Start, Ticket, WhyMissing,
};
use fabrica::data::{SubjectPart, SubjectSink, Volume, Voxels};
use fabrica::document::{Document, ParamValue, RawVoxels, SubjectRef, TemplateMode};
use window::{CUBE, DESK, FOUR, Fake, Queue, RESOLUTION, Window, clock};
