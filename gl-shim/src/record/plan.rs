//! How a command's parameters are recorded, worked out once from what is known of the command.

use std::sync::{LazyLock, OnceLock};

use afterglow_api::{Base, Command, CommandId, Length, Param, id};

use super::number::Number;

/// How a parameter is recorded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Number(Number),
    /// A number whose meaning the parameter name at that position decides.
    Parameter(Number, usize),
    /// An array that is read (or written, see [`Plan::is_written`]).
    Array(Number, Length),
    /// As many numbers as the parameter name at that position has; they may be enumerants.
    Parameters(Number, usize),
    /// The same, of numbers only; most are written by the command.
    Answers(Number, usize),
    /// All values of the pixel map of the first argument, written by the command.
    PixelMap(Number),
    /// As many bytes as an argument says.
    Bytes(usize),
    /// An image that the pixel store describes: format, type, and up to three sizes.
    Image(&'static [u8]),
    /// glBitmap's image, of these sizes.
    Bitmap(&'static [u8]),
    Stipple,
    /// Control points of an evaluator, of so many dimensions.
    Points(Number, usize),
    /// glCallLists: count and type of names.
    Lists(usize, usize),
    /// Indices of a draw: count and type.
    Indices(usize, usize),
    /// Indices of several draws: counts, type and number of draws.
    IndexLists,
    /// A C string, which is only returned.
    Text,
}

/// What more there is to a command than its parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    Plain,
    /// glVertexPointer and its like.
    ArrayPointer,
    InterleavedArrays,
    ArrayElement,
    /// A draw: positions of first vertex, and count.
    Arrays,
    /// A draw by index: positions of count, type and indices.
    Elements(usize),
    MultiArrays,
    MultiElements,
    Unmap,
}

/// How a command is recorded.
#[derive(Debug)]
pub struct Plan {
    pub names: Box<[&'static str]>,
    pub kinds: Box<[Kind]>,
    /// Which parameters are written by the command, and so recorded when it is left.
    written: u32,
    pub result: Option<Kind>,
    pub role: Role,
}

impl Plan {
    pub fn is_written(&self, parameter: usize) -> bool {
        self.written >> parameter & 1 != 0
    }

    fn new(command: &'static Command, canonical: CommandId) -> Plan {
        let params = command.params.iter().enumerate();
        let kinds: Box<[Kind]> = command.params.iter().map(|param| kind(command, canonical, param)).collect();
        let written = params
            .filter(|(i, param)| {
                let holds_values =
                    matches!(kinds[*i], Kind::Array(..) | Kind::Answers(..) | Kind::PixelMap(_));
                param.ctype.pointers > 0 && !param.ctype.constant && holds_values
            })
            .fold(0, |written, (i, _)| written | 1 << i);
        Plan {
            names: command.params.iter().map(|param| name(command, param)).collect(),
            kinds,
            written,
            result: result(command),
            role: role(canonical),
        }
    }
}

/// The plan of a command.
pub fn plan(id: CommandId) -> &'static Plan {
    static PLANS: LazyLock<Vec<OnceLock<Plan>>> =
        LazyLock::new(|| Command::all().iter().map(|_| OnceLock::new()).collect());
    PLANS[id.index()].get_or_init(|| Plan::new(id.command(), id.canonical()))
}

/// The parameter's name in a trace: where the registry has renamed it, the name that tracers use.
fn name(command: &Command, param: &Param) -> &'static str {
    match (command.name, param.name) {
        ("glGetBooleanv" | "glGetDoublev" | "glGetFloatv" | "glGetIntegerv", "data") => "params",
        ("glMultiDrawArraysEXT" | "glMultiDrawElementsEXT", "primcount") => "drawcount",
        ("glColorTableEXT", "internalFormat") => "internalformat",
        ("glDrawBuffer", "buf") | ("glReadBuffer", "src") => "mode",
        ("glDepthRange", "n") => "zNear",
        ("glDepthRange", "f") => "zFar",
        (_, name) => name,
    }
}

fn result(command: &Command) -> Option<Kind> {
    let ctype = command.result;
    let param = Param { name: "", ctype, length: Length::Unknown, group: "" };
    match (ctype.base, ctype.pointers) {
        (Base::UByte, 1) => Some(Kind::Text),
        (_, 1..) => Some(Kind::Number(Number::Address)),
        // A number of hits or values, but tracers have it so.
        (Base::Int, 0) if command.name == "glRenderMode" => Some(Kind::Number(Number::Enum)),
        (Base::Enum, 0) if command.name == "glGetError" => Some(Kind::Number(Number::Error)),
        (_, 0) => Number::of(&param).map(Kind::Number),
    }
}

fn role(canonical: CommandId) -> Role {
    match canonical {
        id::glInterleavedArrays => Role::InterleavedArrays,
        id::glArrayElement => Role::ArrayElement,
        id::glDrawArrays => Role::Arrays,
        id::glDrawElements => Role::Elements(1),
        id::glDrawRangeElements => Role::Elements(3),
        id::glMultiDrawArrays => Role::MultiArrays,
        id::glMultiDrawElements => Role::MultiElements,
        id::glUnmapBuffer => Role::Unmap,
        id if id.name().ends_with("Pointer") || id.name().ends_with("PointerEXT") => Role::ArrayPointer,
        _ => Role::Plain,
    }
}

fn kind(command: &'static Command, canonical: CommandId, param: &'static Param) -> Kind {
    let position = |name: &str| command.params.iter().position(|other| other.name == name);
    let number = Number::of(param);
    if param.ctype.pointers == 0 {
        return match (number, position("pname")) {
            (Some(number), Some(pname)) if param.name == "param" => Kind::Parameter(number, pname),
            (Some(number), _) => Kind::Number(number),
            (None, _) => Kind::Number(Number::Address),
        };
    }
    if canonical == id::glMultiDrawElements && param.name == "indices" {
        return Kind::IndexLists;
    }
    match (number, param.length) {
        (_, Length::Count(_)) if param.ctype.pointers == 2 => Kind::Array(Number::Address, param.length),
        _ if param.ctype.pointers == 2 => Kind::Number(Number::Address),
        (Some(number), Length::Count(_) | Length::Param(_) | Length::Product(..)) => {
            Kind::Array(number, param.length)
        }
        (None, Length::Param(count)) if param.ctype.constant => Kind::Bytes(count.into()),
        (_, Length::Computed(of)) => computed(canonical, param, number, of, position("pname")),
        _ => Kind::Number(Number::Address),
    }
}

/// Memory whose size the registry leaves to a function of the parameters `of`.
fn computed(
    canonical: CommandId,
    param: &Param,
    number: Option<Number>,
    of: &'static [u8],
    pname: Option<usize>,
) -> Kind {
    match (canonical, of, number) {
        (id::glGetPixelMapfv | id::glGetPixelMapuiv | id::glGetPixelMapusv, _, Some(number)) => {
            Kind::PixelMap(number)
        }
        (id::glBitmap, ..) => Kind::Bitmap(of),
        (id::glPolygonStipple, ..) => Kind::Stipple,
        (id::glMap1d | id::glMap1f, _, Some(number)) => Kind::Points(number, 1),
        (id::glMap2d | id::glMap2f, _, Some(number)) => Kind::Points(number, 2),
        (id::glCallLists, &[count, kind], _) => Kind::Lists(count.into(), kind.into()),
        (id::glDrawElements | id::glDrawRangeElements, &[count, kind], _) => {
            Kind::Indices(count.into(), kind.into())
        }
        (id::glFogfv | id::glFogiv, &[of], Some(number)) => Kind::Answers(number, of.into()),
        (_, &[of], Some(number)) if pname.is_some() && param.ctype.constant => {
            Kind::Parameters(number, of.into())
        }
        (_, &[of], Some(number)) if pname.is_some() => Kind::Answers(number, of.into()),
        (_, [_, _, _, ..], None) if param.ctype.constant && param.name != "pointer" => Kind::Image(of),
        _ => Kind::Number(Number::Address),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plans_follow_from_the_registry() {
        let kinds = |id| plan(id).kinds.to_vec();
        assert_eq!(kinds(id::glBegin), [Kind::Number(Number::Primitive)]);
        assert_eq!(kinds(id::glTexCoord2fv), [Kind::Array(Number::F32, Length::Count(2))]);
        assert_eq!(kinds(id::glGenTextures)[1], Kind::Array(Number::U32, Length::Param(0)));
        assert!(plan(id::glGenTextures).is_written(1) && !plan(id::glDeleteTextures).is_written(1));
        assert_eq!(kinds(id::glLightfv)[2], Kind::Parameters(Number::F32, 1));
        assert!(plan(id::glGetIntegerv).is_written(1));
        assert_eq!(kinds(id::glTexEnvi)[2], Kind::Parameter(Number::I32, 1));
        assert_eq!(kinds(id::glTexImage2D)[8], Kind::Image(&[6, 7, 3, 4]));
        assert_eq!(kinds(id::glBufferSubDataARB)[3], Kind::Bytes(2));
        assert_eq!(kinds(id::glDrawRangeElementsEXT)[5], Kind::Indices(3, 4));
        assert_eq!(plan(id::glVertexPointerEXT).role, Role::ArrayPointer);
        assert_eq!(kinds(id::glReadPixels)[6], Kind::Number(Number::Address));
        let vector = Kind::Array(Number::F32, Length::Count(3));
        let light = [Kind::Number(Number::U64), vector, vector, Kind::Number(Number::F32)];
        assert_eq!(kinds(id::glScenePointLightAFTERGLOW), light);
        assert_eq!(kinds(id::glGetPixelMapusv)[1], Kind::PixelMap(Number::U16));
        assert_eq!(kinds(id::glFogfv)[1], Kind::Answers(Number::F32, 0));
        assert!(!plan(id::glFogfv).is_written(1) && plan(id::glGetPixelMapusv).is_written(1));
        assert_eq!(plan(id::glGetString).result, Some(Kind::Text));
        assert_eq!(plan(id::glIsEnabled).result, Some(Kind::Number(Number::Boolean)));
        assert_eq!(plan(id::glEnd).result, None);
    }
}
