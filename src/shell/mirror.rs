//! The viewer's controls for who does not see its canvas: what the last frame showed as a list, which web/mirror.js
//! makes elements of, and what is asked of them.
//!
//! The interface tells its tree to assistive technology natively; a browser takes no such tree of a canvas.

use egui::accesskit::{
    Action, ActionData, ActionRequest, Node, NodeId, Role, Toggled, TreeId, TreeUpdate,
};
use serde_json::{Value, json};

/// The controls of the last frame, once somebody has asked for them, and what is asked of them since.
#[derive(Default)]
pub(super) struct Mirror {
    tree: Option<TreeUpdate>,
    /// The tree was not listed yet.
    is_new: bool,
    asked: Vec<ActionRequest>,
}

impl Mirror {
    /// True once there is a tree.
    pub(super) fn has_list(&self) -> bool {
        self.tree.is_some()
    }

    /// A line for each control and text that is seen: see `Viewer::controls`.
    pub(super) fn lines(&self, ctx: &egui::Context) -> String {
        use std::fmt::Write as _;
        let mut text = String::new();
        let nodes = self.tree.iter().flat_map(|tree| &tree.nodes);
        let plain = |text: Option<&str>| text.unwrap_or_default().replace(['\t', '\n', '\r'], " ");
        for (_, node) in nodes {
            let (name, value) = (plain(node.label()), plain(node.value()));
            let Some([x, y, w, h]) = place(ctx, node) else {
                continue;
            };
            if name.is_empty() && value.is_empty() {
                continue;
            }
            let role = node.role();
            let _infallible = writeln!(
                text,
                "{role:?}\t{name}\t{value}\t{x:.0}\t{y:.0}\t{w:.0}\t{h:.0}"
            );
        }
        text
    }

    /// The controls and texts in their order, as a JSON list, if there is a newer one than at the last call. Each has
    /// `id`, `role`, `name`, `value` (a text), `number` with `min` and `max`, `on` (true, false, or null for neither),
    /// `off` (it cannot be used now), `press` (it can be clicked), and `at`: left, top, width, height, CSS pixels.
    pub(super) fn list(&mut self, ctx: &egui::Context) -> String {
        let (Some(tree), true) = (&self.tree, self.is_new) else {
            return String::new();
        };
        self.is_new = false;
        let nodes: std::collections::BTreeMap<NodeId, &Node> =
            tree.nodes.iter().map(|(id, node)| (*id, node)).collect();
        let mut listed: Vec<Value> = Vec::new();
        let mut waiting: Vec<NodeId> = tree.tree.iter().map(|info| info.root).collect();
        while let Some(id) = waiting.pop() {
            let Some(node) = nodes.get(&id) else {
                continue;
            };
            waiting.extend(node.children().iter().rev());
            let by: Vec<&str> = node
                .labelled_by()
                .iter()
                .filter_map(|other| nodes.get(other))
                .filter_map(|other| other.value().or(other.label()))
                .collect();
            let by = by.join(" ");
            let name = node
                .label()
                .or(Some(by.as_str()).filter(|by| !by.is_empty()));
            listed.extend(told(ctx, id, node, name));
        }
        Value::Array(listed).to_string()
    }

    /// Keeps what is asked of a control for the next frame. False if that is nothing known.
    pub(super) fn ask(&mut self, id: &str, action: &str, value: &str) -> bool {
        let Ok(id) = id.parse() else {
            return false;
        };
        let (action, data) = match action {
            "focus" => (Action::Focus, None),
            "click" => (Action::Click, None),
            "text" => (Action::SetValue, Some(ActionData::Value(value.into()))),
            "number" => match value.parse() {
                Ok(number) => (Action::SetValue, Some(ActionData::NumericValue(number))),
                Err(_) => return false,
            },
            _ => return false,
        };
        self.asked.push(ActionRequest {
            action,
            target_tree: TreeId::ROOT,
            target_node: NodeId(id),
            data,
        });
        true
    }
}

/// Left, top, width and height of a control, CSS pixels.
fn place(ctx: &egui::Context, node: &Node) -> Option<[f64; 4]> {
    let factor = f64::from(ctx.zoom_factor());
    let bounds = node.bounds()?;
    Some([bounds.x0, bounds.y0, bounds.width(), bounds.height()].map(|v| v * factor))
}

/// A control or a text for [`Mirror::list`]; none for what only holds others.
fn told(ctx: &egui::Context, id: NodeId, node: &Node, name: Option<&str>) -> Option<Value> {
    let at = place(ctx, node)?.map(f64::round);
    let (role, value) = (node.role(), node.value());
    let holds_others = matches!(role, Role::Window | Role::GenericContainer | Role::TextRun);
    if holds_others || (name.is_none() && value.is_none()) {
        return None;
    }
    Some(json!({
        "id": id.0.to_string(),
        "role": format!("{role:?}"),
        "name": name,
        "value": value,
        "number": node.numeric_value(),
        "min": node.min_numeric_value(),
        "max": node.max_numeric_value(),
        "on": node.toggled().map(|toggled| toggled == Toggled::True),
        "off": node.is_disabled(),
        "press": node.supports_action(Action::Click),
        "at": at,
    }))
}

impl egui::Plugin for Mirror {
    fn debug_name(&self) -> &'static str {
        "mirror"
    }

    fn input_hook(&mut self, _ctx: &egui::Context, input: &mut egui::RawInput) {
        let asked = self.asked.drain(..);
        input
            .events
            .extend(asked.map(egui::Event::AccessKitActionRequest));
    }

    fn output_hook(&mut self, _ctx: &egui::Context, output: &mut egui::FullOutput) {
        if let Some(tree) = output.platform_output.accesskit_update.take() {
            self.tree = Some(tree);
            self.is_new = true;
        }
    }
}
