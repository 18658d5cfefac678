//! The page: starts the viewer on a canvas.

use wasm_bindgen::prelude::*;

/// One viewer on one canvas.
#[wasm_bindgen]
pub struct Viewer {
    runner: eframe::WebRunner,
    canvas: web_sys::HtmlCanvasElement,
}

#[wasm_bindgen]
impl Viewer {
    /// A viewer for this canvas; nothing is shown until [`Viewer::start`].
    #[wasm_bindgen(constructor)]
    pub fn new(canvas: web_sys::HtmlCanvasElement) -> Self {
        Self {
            runner: eframe::WebRunner::new(),
            canvas,
        }
    }

    /// Starts drawing.
    ///
    /// # Errors
    /// If there is no WebGPU device for the canvas.
    pub async fn start(&self) -> Result<(), JsValue> {
        let options = eframe::WebOptions {
            renderer: eframe::Renderer::Wgpu,
            dithering: false,
            ..Default::default()
        };
        let runner = self.runner.clone();
        runner
            .start(
                self.canvas.clone(),
                options,
                Box::new(|_cc| Ok(Box::new(Hello))),
            )
            .await
    }

    /// True if a fault has stopped the viewer.
    pub fn has_panicked(&self) -> bool {
        self.runner.has_panicked()
    }

    /// What stopped it, or nothing.
    pub fn panic_message(&self) -> String {
        self.runner
            .panic_summary()
            .map(|s| s.message())
            .unwrap_or_default()
    }
}

struct Hello;

impl eframe::App for Hello {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        egui::CentralPanel::default().show(ui, |ui| ui.heading("Fabrica"));
    }
}

/// Called once when the program has been loaded, in the page and in every worker. Starting is left to web/start.js.
pub fn loaded() {}
