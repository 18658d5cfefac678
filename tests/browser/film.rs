//! Every frame that the browser shows of a tab, one after the other.

use super::harness::{Tab, from_base64};
use chromiumoxide::Page;
use chromiumoxide::cdp::browser_protocol::page::{
    EventScreencastFrame, ScreencastFrameAckParams, StartScreencastFormat, StartScreencastParams,
    StopScreencastParams,
};
use futures::StreamExt as _;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// A frame that has not come within this time does not come.
const PATIENCE: Duration = Duration::from_secs(30);

/// Keeps frames until it is ended.
pub(crate) struct Film {
    page: Page,
    frames: Arc<Mutex<Vec<String>>>,
}

impl Film {
    /// Keeps the frames of a tab from now on, beginning with what it shows.
    pub(crate) async fn start(tab: &Tab) -> Self {
        let page = tab.page.clone();
        let mut events = page
            .event_listener::<EventScreencastFrame>()
            .await
            .expect("frames are told of");
        let frames = Arc::<Mutex<Vec<String>>>::default();
        let (kept, asked) = (Arc::clone(&frames), page.clone());
        tokio::spawn(async move {
            while let Some(event) = events.next().await {
                if let Ok(mut frames) = kept.lock() {
                    frames.push(event.data.clone().into());
                }
                // The browser sends the next one when it has heard that this one is there.
                let heard = ScreencastFrameAckParams::new(event.session_id);
                if asked.execute(heard).await.is_err() {
                    break;
                }
            }
        });
        let params = StartScreencastParams::builder()
            .format(StartScreencastFormat::Png)
            .build();
        page.execute(params).await.expect("frames are sent");
        Self { page, frames }
    }

    /// Waits until a frame has come that is as wanted.
    pub(crate) async fn shows(&self, is_wanted: impl Fn(&image::RgbaImage) -> bool) {
        let start = Instant::now();
        loop {
            let last = self.frames.lock().expect("nobody panicked").last().cloned();
            if last.is_some_and(|last| is_wanted(&read(&last))) {
                return;
            }
            assert!(start.elapsed() < PATIENCE, "no such frame is shown");
            tokio::time::sleep(Duration::from_millis(50)).await;
        }
    }

    /// The frames so far, in order.
    pub(crate) async fn end(self) -> Vec<image::RgbaImage> {
        let ended = self.page.execute(StopScreencastParams {}).await;
        ended.expect("no more frames are sent");
        let frames = self.frames.lock().expect("nobody panicked");
        frames.iter().map(|png| read(png)).collect()
    }
}

fn read(png: &str) -> image::RgbaImage {
    let picture = image::load_from_memory(&from_base64(png)).expect("a PNG");
    picture.to_rgba8()
}
