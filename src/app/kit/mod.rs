//! Widgets, colours, type, drawn icons and sheets of pictures that every panel uses.

pub(crate) mod clay_tool;
pub(crate) mod dialog;
pub(crate) mod entry;
pub(crate) mod figure_tool;
pub(crate) mod float;
pub(crate) mod icon;
pub(crate) mod menu;
pub(crate) mod sheet;
pub(crate) mod slow_click;
pub(crate) mod template_menu;
pub(crate) mod theme;
pub(crate) mod widget;
