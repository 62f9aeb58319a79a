//! Calls with arguments that make no sense, as a damaged or hostile trace may hold them: they may be skipped or
//! raise errors, but never panic.

use afterglow_api::{Api, Base, Command, CommandId, Param, Scope};
use afterglow_gl::Context;
use afterglow_gl::backend::NullBackend;
use afterglow_trace::Value;

use crate::args::Args;
use crate::generated::dispatch;

/// xorshift64*: the same calls in every run.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 33) as usize % bound
    }

    fn pick<T: Copy>(&mut self, values: &[T]) -> T {
        values[self.below(values.len())]
    }

    /// Mostly what the parameter's type allows, now and then anything.
    fn value(&mut self, param: &Param) -> Value {
        match (self.below(16), param.ctype.pointers) {
            (0, _) => self.anything(),
            (1..=4, 1) => Value::Blob(vec![self.below(256) as u8; self.below(300)].into()),
            (5, 1..) => Value::Null,
            (6, 1..) => Value::Pointer(self.below(100) as u64),
            (_, 1..) => Value::Array((0..self.below(20)).map(|_| self.scalar(param.ctype.base)).collect()),
            (_, 0) => self.scalar(param.ctype.base),
        }
    }

    fn scalar(&mut self, base: Base) -> Value {
        match base {
            Base::Enum | Base::Bitfield => Value::UInt(self.enumerant().into()),
            Base::Float | Base::Clampf => {
                Value::Float(self.pick(&[0.0, 1.0, -1.0, 0.5, 1e30, f32::NAN, f32::INFINITY]))
            }
            Base::Double | Base::Clampd => Value::Double(self.pick(&[0.0, 1.0, -1.0, 1e300, f64::NAN])),
            Base::Boolean => Value::Bool(self.below(2) == 1),
            _ => Value::SInt(self.pick(&[
                0,
                1,
                2,
                3,
                4,
                5,
                8,
                16,
                17,
                64,
                -1,
                -8,
                i64::from(i32::MAX),
                i64::from(i32::MIN),
            ])),
        }
    }

    /// One of OpenGL's numbers, from wherever there are many of them.
    fn enumerant(&mut self) -> u32 {
        let range = self.pick(&[
            (0, 16),
            (0x200, 8),
            (0x300, 16),
            (0x400, 16),
            (0xb00, 0x200),
            (0xde0, 0x20),
            (0x1200, 0x20),
            (0x1400, 16),
            (0x1700, 16),
            (0x1900, 16),
            (0x1e00, 16),
            (0x2100, 8),
            (0x2600, 4),
            (0x2700, 4),
            (0x2800, 4),
            (0x3000, 8),
            (0x4000, 8),
            (0x8000, 0x100),
            (0x8500, 0x80),
            (0x84c0, 8),
            (0x8890, 0x60),
        ]);
        range.0 + self.below(range.1) as u32
    }

    fn anything(&mut self) -> Value {
        match self.below(6) {
            0 => Value::Absent,
            1 => Value::Null,
            2 => Value::UInt(u64::MAX),
            3 => Value::String((*b"text").into()),
            4 => Value::Array(vec![Value::Absent; self.below(5)]),
            _ => Value::Float(f32::NAN),
        }
    }
}

/// Whether calls with random sizes would rather test the machine's memory.
fn is_greedy(command: &Command) -> bool {
    matches!(command.name, "glBufferData" | "glReadPixels")
}

#[test]
fn no_call_panics() {
    let commands = Command::all().iter().filter(|command| {
        let canonical = CommandId::named(command.name).is_some_and(|id| id.canonical() == id);
        command.api == Api::Gl && command.scope == Scope::Classic && canonical && !is_greedy(command)
    });
    let commands: Vec<&Command> = commands.collect();
    let mut random = Random(0x1234_5678_9abc_def1);
    for _ in 0..150 {
        let mut gl = Context::new(Box::new(NullBackend), Default::default());
        gl.set_drawable(16, 16);
        for _ in 0..2000 {
            let command = random.pick(&commands);
            let mut args: Vec<Value> = command.params.iter().map(|param| random.value(param)).collect();
            if random.below(50) == 0 {
                args.pop();
            }
            let id = CommandId::named(command.name).unwrap();
            let call = std::panic::AssertUnwindSafe(|| dispatch::play(&mut gl, id, Args(&args)));
            if let Err(panic) = std::panic::catch_unwind(call) {
                eprintln!("{}{args:?}", command.name);
                std::panic::resume_unwind(panic);
            }
            // Else most of the calls would be errors between glBegin and glEnd, or be kept in a list.
            if random.below(8) == 0 {
                gl.end();
                gl.end_list();
            }
            gl.get_error();
        }
        gl.swap_buffers();
    }
}
