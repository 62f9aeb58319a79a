//! Occlusion queries (specification 4.1.6).

use afterglow_api::constants::*;
use hashbrown::HashMap;

use crate::backend::{Reply, Request};
use crate::context::Context;
use crate::frame::Operation;
use crate::limits;

/// Queries of a context.
#[derive(Debug, Default)]
pub struct ActiveQuery {
    active: Option<u32>,
    /// By name.
    queries: HashMap<u32, Query>,
    last: u32,
}

/// A query.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Query {
    /// Only its name is taken.
    Reserved,
    /// It was begun.
    Begun,
    /// Its result is known.
    Known(u32),
}

impl Context {
    /// glGenQueries.
    pub fn gen_queries(&mut self, n: i32) -> Vec<u32> {
        if !(0..=limits::GENERATED_NAMES).contains(&n) {
            self.record_error(GL_INVALID_VALUE);
            return Vec::new();
        }
        let queries = &mut self.queries;
        let mut fresh = || {
            loop {
                queries.last = queries.last.wrapping_add(1).max(1);
                if !queries.queries.contains_key(&queries.last) {
                    queries.queries.insert(queries.last, Query::Reserved);
                    return queries.last;
                }
            }
        };
        (0..n).map(|_| fresh()).collect()
    }

    /// glDeleteQueries.
    pub fn delete_queries(&mut self, names: &[u32]) {
        for name in names {
            self.queries.queries.remove(name);
        }
    }

    /// glIsQuery.
    pub fn is_query(&mut self, name: u32) -> bool {
        self.queries.queries.get(&name).is_some_and(|query| *query != Query::Reserved)
    }

    pub(crate) fn exec_begin_query(&mut self, target: u32, id: u32) {
        if target != GL_SAMPLES_PASSED {
            return self.record_error(GL_INVALID_ENUM);
        }
        if id == 0 || self.queries.active.is_some() {
            return self.record_error(GL_INVALID_OPERATION);
        }
        self.queries.active = Some(id);
        self.queries.queries.insert(id, Query::Begun);
        self.frame.operations.push(Operation::BeginQuery(id));
    }

    pub(crate) fn exec_end_query(&mut self, target: u32) {
        if target != GL_SAMPLES_PASSED {
            return self.record_error(GL_INVALID_ENUM);
        }
        match self.queries.active.take() {
            Some(id) => self.frame.operations.push(Operation::EndQuery(id)),
            None => self.record_error(GL_INVALID_OPERATION),
        }
    }

    /// glGetQuery; `None` after an error.
    pub fn get_query(&mut self, target: u32, pname: u32) -> Option<i32> {
        match (target, pname) {
            (GL_SAMPLES_PASSED, GL_CURRENT_QUERY) => Some(self.queries.active.unwrap_or(0) as i32),
            (GL_SAMPLES_PASSED, GL_QUERY_COUNTER_BITS) => Some(32),
            _ => {
                self.record_error(GL_INVALID_ENUM);
                None
            }
        }
    }

    /// glGetQueryObject. Waits for the result. `None` after an error.
    pub fn get_query_object(&mut self, id: u32, pname: u32) -> Option<u32> {
        if !self.is_query(id) || self.queries.active == Some(id) {
            self.record_error(GL_INVALID_OPERATION);
            return None;
        }
        match pname {
            GL_QUERY_RESULT_AVAILABLE => Some(1),
            GL_QUERY_RESULT => Some(self.query_result(id)),
            _ => {
                self.record_error(GL_INVALID_ENUM);
                None
            }
        }
    }

    fn query_result(&mut self, id: u32) -> u32 {
        if let Some(Query::Known(samples)) = self.queries.queries.get(&id) {
            return *samples;
        }
        let samples = match self.ask(Request::Query(id)) {
            Reply::Samples(samples) => samples,
            _ => 0,
        };
        self.queries.queries.insert(id, Query::Known(samples));
        samples
    }
}
