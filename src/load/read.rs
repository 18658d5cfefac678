use std::cell::RefCell;
use std::rc::Rc;

use sha2::{Digest as _, Sha256};

use super::error::FaultKind;
use super::files::{self, ALL_FILES, FileSet, open};
use super::mesh::format::MeshKind;
use super::options::ReadOptions;
use super::place::{self, Source};
use super::sniff::{Kind, SNIFF_BYTES, sniff};
use super::stream::{Packing, SharedHash};
use super::{LoadError, LoadReport, dicom, metaimage, nifti, nrrd};
use crate::data::SubjectSink;

/// Reads a volume from the file of this name in `files`, told by its content first, by its name where content says
/// nothing. Streams: the sink has the first voxels long before the last byte was read. The file is read to its end, so
/// that `report` holds the hash of its bytes.
///
/// # Errors
/// [`LoadError`], with name and place. The sink may have begun by then, and what it holds is to be thrown away.
pub fn read_volume(
    files: &mut dyn FileSet,
    name: &str,
    options: &ReadOptions,
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    let hash: SharedHash = Rc::new(RefCell::new(Sha256::new()));
    let mut reading = Reading {
        files,
        options,
        sink,
        report,
        hash,
    };
    let own = reading.read(name)?;
    let digest = own.unwrap_or_else(|| reading.hash.borrow().clone().finalize().into());
    report.sha256 = Some(digest);
    Ok(())
}

/// What all readers share while one file is read.
struct Reading<'a> {
    files: &'a mut dyn FileSet,
    options: &'a ReadOptions,
    sink: &'a mut dyn SubjectSink,
    report: &'a mut LoadReport,
    hash: SharedHash,
}

impl Reading<'_> {
    /// Reads; returns a hash where it is not that of all bytes in the order read.
    fn read(&mut self, name: &str) -> Result<Option<[u8; 32]>, LoadError> {
        if name == ALL_FILES {
            return self.read_dicom(name);
        }
        // The image half of a pair is bare voxels: only its name tells.
        if let Some(headers) = files::siblings(name, "img", "hdr") {
            let header = files::first_there(self.files, name, &headers)?;
            return self.read(&header);
        }
        let mut stream = open(self.files, name, name, Some(&self.hash))?;
        if stream.peek(2)? == [0x1f, 0x8b] {
            stream.unpack(Packing::Gzip);
        }
        let start = stream.peek(SNIFF_BYTES)?;
        let byte_len = stream
            .byte_len()
            .filter(|_| stream.packing() == Packing::Plain);
        let outcome = match sniff(&start, name, byte_len) {
            Kind::Nifti => {
                let pair = nifti::read(&mut stream, name, self.options, self.sink, self.report)?;
                self.report.bytes_read += stream.raw_count();
                drop(stream);
                match pair {
                    None => Ok(()),
                    Some(header) => self.read_image_half(name, &header),
                }
            }
            kind @ (Kind::Nrrd | Kind::MetaImage) => {
                let header = if matches!(kind, Kind::Nrrd) {
                    nrrd::read_header(&mut stream, self.options, self.report)?
                } else {
                    metaimage::read_header(&mut stream, self.options, self.report)?
                };
                match header.files.clone() {
                    None => place::read(Source::Attached(stream), &header, self.sink, self.report),
                    Some(names) => {
                        stream.finish(|_| true)?;
                        self.report.bytes_read += stream.raw_count();
                        drop(stream);
                        self.read_other_files(name, names, &header)
                    }
                }
            }
            Kind::Dicom => {
                drop(stream);
                return self.read_dicom(name);
            }
            Kind::Empty => Err(LoadError::Empty {
                name: name.to_owned(),
            }),
            Kind::Refused(what) => Err(LoadError::Unsupported {
                name: name.to_owned(),
                what: what.to_owned(),
            }),
            Kind::Mesh(kind) => Err(LoadError::NoScan {
                name: name.to_owned(),
                what: match kind {
                    MeshKind::Read(format) => format.not_a_scan(),
                    MeshKind::Refused(words) => words,
                },
                kind: FaultKind::Surface,
            }),
            Kind::NoScan(kind, what) => Err(LoadError::NoScan {
                name: name.to_owned(),
                what,
                kind,
            }),
            Kind::Unknown => Err(LoadError::UnknownFormat {
                name: name.to_owned(),
                begins: start
                    .iter()
                    .take(8)
                    .map(|byte| format!("{byte:02x}"))
                    .collect::<Vec<_>>()
                    .join(" "),
            }),
        };
        outcome.map(|()| None)
    }

    fn read_dicom(&mut self, name: &str) -> Result<Option<[u8; 32]>, LoadError> {
        dicom::read(self.files, name, self.options, self.sink, self.report).map(Some)
    }

    fn read_other_files(
        &mut self,
        name: &str,
        names: Vec<String>,
        header: &place::Header,
    ) -> Result<(), LoadError> {
        let names = names
            .iter()
            .map(|name| files::resolve(self.files, name))
            .collect();
        let source = Source::Files {
            files: self.files,
            header_name: name.to_owned(),
            names,
            hash: self.hash.clone(),
        };
        place::read(source, header, self.sink, self.report)
    }

    fn read_image_half(&mut self, name: &str, header: &nifti::Header) -> Result<(), LoadError> {
        let images = files::siblings(name, "hdr", "img").unwrap_or_default();
        let image = files::first_there(self.files, name, &images)?;
        let mut stream = open(self.files, &image, name, Some(&self.hash))?;
        if image.to_lowercase().ends_with(".gz") && stream.peek(2)? == [0x1f, 0x8b] {
            stream.unpack(Packing::Gzip);
        }
        nifti::read_voxels(&mut stream, header, self.options, self.sink, self.report)?;
        self.report.bytes_read += stream.raw_count();
        Ok(())
    }
}
