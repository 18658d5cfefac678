//! In the page: starts workers, hands them tasks, takes their answers.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

use js_sys::{Object, Promise, Reflect};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;
use web_sys::{MessageEvent, Worker, WorkerOptions, WorkerType};

use super::answer::{Answer, Answers};
use super::task::{Part, ScanTask, Task};
use crate::assets::{BendAnswer, BendRequest, LoadEvent};
use crate::data::{BuildError, Subject, SubjectBuilder, SubjectSink as _, VolumeLimits};
use crate::load::FieldFile;

thread_local! {
    /// Compiled modules of parts that have run, so that their next workers neither fetch nor compile them.
    static MODULES: RefCell<BTreeMap<Part, JsValue>> = const { RefCell::new(BTreeMap::new()) };
    /// Workers that wait for a task: those that web/parts.js started while the page's own module was on its way, and
    /// one that has shaped a clay and has kept what its strokes left.
    static WAITING: RefCell<Vec<(Part, Worker)>> = const { RefCell::new(Vec::new()) };
    /// Address of worker.js, as the last viewer was given it.
    static KNOWN_ADDRESS: RefCell<String> = const { RefCell::new(String::new()) };
    /// How many benders of figures there have been.
    static BENDERS: Cell<u32> = const { Cell::new(0) };
}

/// Takes a worker that was started early and has loaded a part, or is loading it.
pub fn lend(part: Part, worker: Worker) {
    WAITING.with_borrow_mut(|waiting| waiting.push((part, worker)));
}

/// Ends the workers that wait for a task.
pub fn end_waiting() {
    for (_, worker) in WAITING.take() {
        worker.terminate();
    }
}

/// Ends the worker that has shaped a clay and waits for its next stroke.
pub fn end_resting() {
    WAITING.with_borrow_mut(|all| {
        for (_, worker) in all.extract_if(.., |(part, _)| *part == Part::Clay) {
            worker.terminate();
        }
    });
}

/// How a worker is made.
#[derive(Clone, Debug)]
pub enum Maker {
    /// From this address of `worker.js`.
    Address(String),
    /// By a function of the page, which returns a worker or what behaves like one.
    Page(js_sys::Function),
}

impl Maker {
    fn make(&self) -> Result<Worker, JsValue> {
        match self {
            Self::Address(address) => {
                let options = WorkerOptions::new();
                options.set_type(WorkerType::Module);
                Worker::new_with_options(address, &options)
            }
            Self::Page(make) => Ok(make.call0(&JsValue::NULL)?.unchecked_into()),
        }
    }
}

impl From<&str> for Maker {
    fn from(address: &str) -> Self {
        Self::Address(address.to_owned())
    }
}

/// A worker for a part: one that waits, if there is one that could be started, else a new one.
fn worker_for(part: Part, maker: &Maker) -> Result<Worker, JsValue> {
    let waiting = WAITING.with_borrow_mut(|waiting| {
        let found = waiting.iter().position(|(other, _)| *other == part)?;
        Some(waiting.swap_remove(found).1)
    });
    let could_start = |worker: &Worker| {
        !Reflect::get(worker, &"hasFailed".into()).is_ok_and(|failed| failed.is_truthy())
    };
    if let Some(worker) = waiting.filter(could_start) {
        return Ok(worker);
    }
    maker.make()
}

/// A task under way. Ends when dropped, and its worker by itself after the last answer, unless that rests.
pub struct WorkerLoad {
    worker: Worker,
    /// The worker waits for another task.
    rests: Rc<Cell<bool>>,
    _on_message: Closure<dyn FnMut(MessageEvent)>,
    _on_error: Closure<dyn FnMut(web_sys::Event)>,
}

impl Drop for WorkerLoad {
    fn drop(&mut self) {
        if !self.rests.get() {
            end(&self.worker);
        }
    }
}

fn end(worker: &Worker) {
    let_go(worker);
    worker.terminate();
}

/// Nobody listens to a worker any more.
fn let_go(worker: &Worker) {
    worker.set_onmessage(None);
    worker.set_onerror(None);
}

/// Starts a task in a worker of its own; `on_answer` is called with each answer but the part's module, which is kept.
///
/// # Errors
/// If the browser starts no workers.
pub fn start(
    maker: &Maker,
    task: &Task,
    limits: VolumeLimits,
    on_answer: impl FnMut(Answer) + 'static,
) -> Result<WorkerLoad, JsValue> {
    let part = task.part();
    let worker = worker_for(part, maker)?;
    let rests = Rc::new(Cell::new(false));
    let comes_to_rest = Rc::clone(&rests);
    let on_answer = Rc::new(RefCell::new(on_answer));
    let (for_error, for_end) = (Rc::clone(&on_answer), worker.clone());
    let mut answers = Answers::default();
    let on_message = Closure::new(
        move |event: MessageEvent| match answers.take(&event.data()) {
            Some(Answer::Module(part, module)) => {
                MODULES.with_borrow_mut(|modules| modules.insert(part, module));
            }
            Some(answer) => {
                let is_done = matches!(answer, Answer::Event(LoadEvent::Done { .. }));
                if is_done && part == Part::Clay {
                    let_go(&for_end);
                    comes_to_rest.set(true);
                    end_resting();
                    lend(part, for_end.clone());
                } else if answer.is_last() {
                    end(&for_end);
                }
                (on_answer.borrow_mut())(answer);
            }
            None => {}
        },
    );
    let on_error = Closure::new(move |_: web_sys::Event| {
        (for_error.borrow_mut())(Answer::Event(LoadEvent::Failed {
            message: "This browser did not start the background thread that loads scans".to_owned(),
            details: "Workers of this page may be blocked: by an extension, by the content policy of a page that embeds the viewer, or because worker.js is not beside fabrica.js.".to_owned(),
            fault: None,
        }));
    });
    worker.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
    worker.set_onerror(Some(on_error.as_ref().unchecked_ref()));
    let module = MODULES.with_borrow(|modules| modules.get(&part).cloned());
    let message: Object = task.message(limits, &module.unwrap_or_default())?;
    worker.post_message(&message)?;
    Ok(WorkerLoad {
        worker,
        rests,
        _on_message: on_message,
        _on_error: on_error,
    })
}

/// The bender of one picture's figure: a worker of its own, from the first request until it is dropped.
pub struct BendWorker {
    maker: Maker,
    /// Tells it from others, where all stand in the page itself.
    number: u32,
    load: Rc<RefCell<Option<WorkerLoad>>>,
}

impl BendWorker {
    /// A bender whose worker is made with the first request.
    pub fn new(maker: Maker) -> Self {
        Self {
            maker,
            number: BENDERS.replace(BENDERS.get() + 1),
            load: Rc::default(),
        }
    }

    /// Stops what is under way; the next request starts another worker.
    pub fn stop(&self) {
        drop(self.load.borrow_mut().take());
    }

    /// Asks; `on_answer` of the request that had to start the worker is called with the answers to all.
    ///
    /// # Errors
    /// If the browser starts no workers.
    pub fn ask(
        &mut self,
        request: BendRequest,
        mut on_answer: impl FnMut(BendAnswer) + 'static,
    ) -> Result<(), JsValue> {
        let task = Task::Bend(self.number, request);
        if let Some(load) = &*self.load.borrow() {
            // The worker has its module.
            let message = task.message(UNLIMITED, &JsValue::TRUE)?;
            return load.worker.post_message(&message);
        }
        let ended = Rc::downgrade(&self.load);
        let load = start(&self.maker, &task, UNLIMITED, move |answer| match answer {
            Answer::Bent(answer) => on_answer(answer),
            Answer::Event(LoadEvent::Failed {
                message, details, ..
            }) => {
                // The closure that runs here goes with it, so it is only put out of use.
                if let Some(load) = ended.upgrade() {
                    let gone = load.borrow_mut().take();
                    wasm_bindgen_futures::spawn_local(async move { drop(gone) });
                }
                let why = [message, details].join(": ");
                on_answer(BendAnswer::Lost(why));
            }
            _ => {}
        })?;
        *self.load.borrow_mut() = Some(load);
        Ok(())
    }
}

/// Does a task to its last answer.
async fn to_end(
    maker: &Maker,
    task: &Task,
    limits: VolumeLimits,
    mut take: impl FnMut(Answer) + 'static,
) -> Result<(), JsValue> {
    let resolve = Rc::new(RefCell::new(None::<js_sys::Function>));
    let for_answer = Rc::clone(&resolve);
    let ended = Promise::new(&mut |done, _| *resolve.borrow_mut() = Some(done));
    let load = start(maker, task, limits, move |answer| {
        let is_last = answer.is_last();
        take(answer);
        if is_last && let Some(done) = &*for_answer.borrow() {
            let _nobody_waits = done.call0(&JsValue::NULL);
        }
    })?;
    JsFuture::from(ended).await?;
    drop(load);
    Ok(())
}

/// Limits that hold nothing back.
const UNLIMITED: VolumeLimits = VolumeLimits {
    max_dim: u32::MAX,
    max_voxels: u64::MAX,
};

/// Reads a displacement field.
///
/// # Errors
/// In words: why the file is no displacement field, or why no worker reads it.
pub async fn read_field(
    maker: &Maker,
    name: String,
    file: web_sys::Blob,
) -> Result<FieldFile, String> {
    let found = Rc::new(RefCell::new(Err("the file was not read".to_owned())));
    let for_answer = Rc::clone(&found);
    let task = Task::Scan(ScanTask::Field { name, file });
    let read = to_end(maker, &task, UNLIMITED, move |answer| match answer {
        Answer::Field(outcome) => *for_answer.borrow_mut() = *outcome,
        Answer::Event(LoadEvent::Failed {
            message, details, ..
        }) => {
            *for_answer.borrow_mut() = Err(format!("{message}: {details}"));
        }
        _ => {}
    });
    match read.await {
        Ok(()) => found.replace(Err(String::new())),
        Err(error) => Err(super::fault::text_of(&error)),
    }
}

/// From now on workers that no viewer starts are started from this address of worker.js.
pub fn set_known_address(address: &str) {
    KNOWN_ADDRESS.set(address.to_owned());
}

/// Where worker.js is, as the last viewer was given it: beside the page, if there has been no viewer.
pub fn known_address() -> String {
    let known = KNOWN_ADDRESS.with_borrow(Clone::clone);
    if known.is_empty() {
        "./worker.js".to_owned()
    } else {
        known
    }
}

/// The subject that a task makes.
///
/// # Errors
/// In words: why there is none.
pub async fn make_subject(address: &str, task: &Task) -> Result<Subject, String> {
    let made = Rc::new(RefCell::new((SubjectBuilder::default(), None::<String>)));
    let for_answer = Rc::clone(&made);
    let maker = address.into();
    let run = to_end(&maker, task, UNLIMITED, move |answer| {
        let (builder, fault) = &mut *for_answer.borrow_mut();
        match answer {
            Answer::Event(LoadEvent::Part(part)) => {
                if let Err(why) = builder.take(part) {
                    *fault = Some(why);
                }
            }
            Answer::Event(LoadEvent::Failed { message, .. }) => *fault = Some(message),
            _ => {}
        }
    });
    run.await.map_err(|error| super::fault::text_of(&error))?;
    let (builder, fault) = made.replace((SubjectBuilder::default(), None));
    if let Some(fault) = fault {
        return Err(fault);
    }
    match builder.finish() {
        Some(Ok((subject, _))) => Ok(subject),
        Some(Err(error)) => Err(error.to_string()),
        None => Err(BuildError::Nothing.to_string()),
    }
}
