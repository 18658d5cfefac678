//! A server on localhost for the built page and for files that a test adds. Each test has its own, at its own port:
//! what one test adds is not there for the next, and origins are fresh.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// A server on localhost for the built page and for files that a test adds.
#[derive(Clone)]
pub(crate) struct Server {
    port: u16,
    shared: Arc<Shared>,
}

struct Shared {
    folder: PathBuf,
    added: Mutex<BTreeMap<String, Vec<u8>>>,
    asked: Mutex<Vec<String>>,
    /// Files whose answers wait.
    held: Mutex<BTreeSet<String>>,
    /// Files that other hosts may not have.
    own: Mutex<BTreeSet<String>>,
}

impl Server {
    /// Serves `folder` at a port of its own until the process ends.
    pub(crate) fn start(folder: PathBuf) -> Self {
        let listener = TcpListener::bind(("127.0.0.1", 0)).expect("a port on localhost");
        let port = listener
            .local_addr()
            .expect("the address just bound")
            .port();
        let shared = Arc::new(Shared {
            folder,
            added: Mutex::default(),
            asked: Mutex::default(),
            held: Mutex::default(),
            own: Mutex::default(),
        });
        let for_thread = Arc::clone(&shared);
        std::thread::spawn(move || {
            for stream in listener.incoming().flatten() {
                let shared = Arc::clone(&for_thread);
                std::thread::spawn(move || shared.answer(stream));
            }
        });
        Self { port, shared }
    }

    /// Another server of the same folder: another origin.
    pub(crate) fn beside(&self) -> Self {
        Self::start(self.shared.folder.clone())
    }

    /// Where it is, without a slash at the end.
    pub(crate) fn address(&self) -> String {
        format!("http://127.0.0.1:{}", self.port)
    }

    /// Serves these bytes at `/name` from now on.
    pub(crate) fn add(&self, name: &str, bytes: Vec<u8>) {
        let mut added = self.shared.added.lock().expect("no answer panicked");
        added.insert(name.to_owned(), bytes);
    }

    /// Answers nothing to who asks for `/name`, as on a slow connection, until it is let go.
    pub(crate) fn hold(&self, name: &str, is_held: bool) {
        let mut held = self.shared.held.lock().expect("no answer panicked");
        let _changed = match is_held {
            true => held.insert(name.to_owned()),
            false => held.remove(name),
        };
    }

    /// Gives `/name` to pages of its own host alone.
    pub(crate) fn keep_to_itself(&self, name: &str) {
        let mut own = self.shared.own.lock().expect("no answer panicked");
        own.insert(name.to_owned());
    }

    /// Paths that were asked for, in order.
    pub(crate) fn asked(&self) -> Vec<String> {
        self.shared
            .asked
            .lock()
            .expect("no answer panicked")
            .clone()
    }
}

impl Shared {
    fn answer(&self, mut stream: TcpStream) {
        let _timeout = stream.set_read_timeout(Some(Duration::from_secs(10)));
        let mut reader = BufReader::new(match stream.try_clone() {
            Ok(stream) => stream,
            Err(_) => return,
        });
        let mut first = String::new();
        if reader.read_line(&mut first).is_err() {
            return;
        }
        let mut line = String::new();
        while reader.read_line(&mut line).is_ok_and(|n| n > 2) {
            line.clear();
        }
        let target = first.split(' ').nth(1).unwrap_or("/").to_owned();
        let path = target.split(['?', '#']).next().unwrap_or("/");
        let name = path.trim_start_matches('/');
        let name = if name.is_empty() { "index.html" } else { name };
        if let Ok(mut asked) = self.asked.lock() {
            asked.push(target.clone());
        }
        let is_held = || self.held.lock().is_ok_and(|held| held.contains(name));
        while is_held() {
            std::thread::sleep(Duration::from_millis(10));
        }
        let added = self.added.lock().ok().and_then(|a| a.get(name).cloned());
        let body = added.or_else(|| {
            (!name.contains("..")).then(|| std::fs::read(self.folder.join(name)).ok())?
        });
        let kind = match name.rsplit('.').next() {
            Some("html") => "text/html; charset=utf-8",
            Some("js") => "text/javascript",
            Some("css") => "text/css",
            Some("wasm") => "application/wasm",
            Some("svg") => "image/svg+xml",
            Some("json") => "application/json",
            Some("png") => "image/png",
            _ => "application/octet-stream",
        };
        let (status, body) = match body {
            Some(body) => ("200 OK", body),
            None => ("404 Not Found", b"no such file".to_vec()),
        };
        let is_own = self.own.lock().is_ok_and(|own| own.contains(name));
        let allowed = match is_own {
            true => "",
            false => "Access-Control-Allow-Origin: *\r\n",
        };
        let head = format!(
            "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {}\r\nCache-Control: no-store\r\n{allowed}Connection: close\r\n\r\n",
            body.len()
        );
        let _sent = stream
            .write_all(head.as_bytes())
            .and_then(|()| stream.write_all(&body));
        let _shut = stream.shutdown(std::net::Shutdown::Write);
        let _drained = stream.read(&mut [0; 1]);
    }
}
