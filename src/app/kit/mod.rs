//! Widgets, colours, type and drawn icons that every panel uses.

pub(crate) mod float;
pub(crate) mod icon;
pub(crate) mod menu;
pub(crate) mod slow_click;
pub(crate) mod template_menu;
pub(crate) mod theme;
pub(crate) mod widget;
