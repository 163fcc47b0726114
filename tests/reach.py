"""What users reach of the package, by the names that its code resolves, not by their text.

A function, class or value of a module is a place, ``("loadflow.shaft.beam", "Beam")``. From the
places that users enter by, `reached` follows every name that the code there resolves to: through
imports, rooms that load when used, attributes of modules, and texts that name a place
(``"package.module:NAME"``). Names that a function binds itself are not those of its module.
"""

import ast
import re
from collections import defaultdict
from dataclasses import dataclass, field
from functools import cached_property

BODY = "<body>"
"""Stands for what a module does when it is imported."""
PLACE = re.compile(r"([A-Za-z_][\w.]*):([A-Za-z_]\w*)")
FUNCTION = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)


@dataclass
class Module:
    """A module: its tree, and what each of its names is.

    `parts` holds the statements that make a name, `imports` where an imported name comes from: a
    module, or a module and a name in it.
    """

    name: str
    tree: ast.Module
    package: bool = False
    parts: dict = field(default_factory=lambda: defaultdict(list))
    imports: dict = field(default_factory=dict)

    def __post_init__(self):
        self.take(self.tree.body)

    def take(self, statements):
        for node in statements:
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
                self.parts[node.name].append(node)
            elif isinstance(node, ast.Import | ast.ImportFrom):
                self.imports |= imported(node, self)
                self.parts[BODY].append(node)
            elif isinstance(node, ast.If | ast.Try):
                self.parts[BODY] += [node.test] if isinstance(node, ast.If) else []
                for part in ("body", "handlers", "orelse", "finalbody"):
                    for inner in getattr(node, part, ()):
                        self.take(inner.body if isinstance(inner, ast.ExceptHandler) else [inner])
            elif isinstance(node, ast.Assign | ast.AnnAssign | ast.AugAssign):
                targets = node.targets if isinstance(node, ast.Assign) else [node.target]
                names = [n.id for t in targets for n in ast.walk(t) if isinstance(n, ast.Name)]
                plain = all(isinstance(t, ast.Name | ast.Tuple) for t in targets)
                for name in names if plain else [BODY]:
                    self.parts[name].append(node)
            else:
                self.parts[BODY].append(node)

    @property
    def methods(self):
        """Class and name of the methods and properties without an underscore before either."""
        for name, parts in self.parts.items():
            for made in (p for p in parts if isinstance(p, ast.ClassDef) and name[:1] != "_"):
                for inner in made.body:
                    if isinstance(inner, ast.FunctionDef) and inner.name[:1] != "_":
                        yield name, inner.name

    @property
    def public(self):
        """Functions and classes without an underscore before their name."""
        for name, parts in self.parts.items():
            made = any(isinstance(p, ast.FunctionDef | ast.ClassDef) for p in parts)
            if made and not name.startswith("_"):
                yield name


def imported(node, module):
    """Where the names of an import come from."""
    if isinstance(node, ast.Import):
        return {
            one.asname or one.name.partition(".")[0]: one.name
            if one.asname
            else one.name.partition(".")[0]
            for one in node.names
        }
    home = node.module or ""
    if node.level:
        above = module.name.split(".")
        above = above[: len(above) - node.level + module.package]
        home = ".".join([*above, home] if home else above)
    return {one.asname or one.name: (home, one.name) for one in node.names}


def bound(function):
    """Names that a function binds: arguments and what it assigns, not what it imports."""
    given = function.args
    names = {a.arg for a in (*given.posonlyargs, *given.args, *given.kwonlyargs)}
    names |= {a.arg for a in (given.vararg, given.kwarg) if a is not None}
    inner = list(function.body) if isinstance(function.body, list) else [function.body]
    while inner:
        node = inner.pop()
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            names.add(node.id)
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            names.add(node.name)
        elif not isinstance(node, ast.Lambda):
            inner += ast.iter_child_nodes(node)
    return names


@dataclass
class Package:
    """Modules by name, and for packages whose names load when used, where each comes from."""

    modules: dict
    stubs: dict = field(default_factory=dict)
    uses: dict = field(default_factory=dict)
    asked: dict = field(default_factory=dict)
    handed: dict = field(default_factory=dict)
    texts: dict = field(default_factory=dict)

    @classmethod
    def at(cls, folder):
        """The package in a folder."""
        modules, stubs = {}, {}
        for path in sorted(folder.rglob("*.py*")):
            if path.suffix in (".py", ".pyi"):
                parts = path.relative_to(folder.parent).with_suffix("").parts
                package = parts[-1] == "__init__"
                name = ".".join(parts[:-1] if package else parts)
                tree = ast.parse(path.read_text(encoding="utf-8"))
                (modules if path.suffix == ".py" else stubs)[name] = Module(name, tree, package)
        return cls(modules, {name: stub.imports for name, stub in stubs.items()})

    def find(self, module, name, seen=()):
        """Place or module that a name of a module is; None of what is not of this package."""
        if (module, name) in seen or module not in self.modules:
            return None
        here = self.modules[module]
        if name in here.parts:
            return module, name
        for imports in (here.imports, self.stubs.get(module, {})):
            if name in imports:
                return self.follow(imports[name], (*seen, (module, name)))
        below = f"{module}.{name}"
        return below if below in self.modules else None

    def follow(self, source, seen=()):
        """Place or module that an import gives."""
        if isinstance(source, str):
            return source if source in self.modules else None
        home, name = source
        found = self.find(home, name, seen)
        below = f"{home}.{name}"
        return below if found is None and below in self.modules else found

    @cached_property
    def registered(self):
        """Places that register with another one: ``@app.command()``, ``@made.register``."""
        found = defaultdict(set)
        for module in self.modules.values():
            for name, part in ((n, p) for n, parts in module.parts.items() for p in parts):
                for told in getattr(part, "decorator_list", ()):
                    called = told.func if isinstance(told, ast.Call) else told
                    if isinstance(called, ast.Attribute):
                        where = Reading(self, module).resolved(called.value)
                        found[where].add((module.name, name))
        return found

    def used_by(self, place):
        """Places that a place uses."""
        if place not in self.uses:
            module = self.modules[place[0]]
            reading = Reading(self, module)
            self.uses[place] = reading.of(module.parts.get(place[1], ())) | self.registered[place]
            self.asked[place], self.handed[place] = reading.asked, reading.handed
            self.texts[place] = reading.texts
        return self.uses[place]

    def reached(self, places):
        """All places that are reached from some."""
        seen, waiting, attributes, handed = set(), list(places), set(), set()
        while waiting:
            while waiting:
                place = waiting.pop()
                if place in seen or place[0] not in self.modules:
                    continue
                seen.add(place)
                above = place[0].split(".")
                waiting += [(".".join(above[: n + 1]), BODY) for n in range(len(above))]
                waiting += self.used_by(place)
                attributes |= self.asked[place]
                handed |= self.handed[place]
            of_modules = {(home, name) for home in handed for name in self.modules[home].parts}
            waiting = [p for p in of_modules - seen if p[1] in attributes]
        return seen

    def fields_asked(self, places):
        """Attributes that some places ask for, and texts that may name one (``getattr``)."""
        for place in places:
            self.used_by(place)
        return set().union(*(self.asked[place] | self.texts[place] for place in places))

    def reached_by(self, scripts):
        """Places of the package that scripts reach, such as the blocks of a page."""
        made = {f"<{k}>": Module(f"<{k}>", ast.parse(text)) for k, text in enumerate(scripts)}
        whole = Package(self.modules | made, self.stubs)
        places = ((name, part) for name, script in made.items() for part in script.parts)
        return {place for place in whole.reached(places) if place[0] not in made}


class Reading(ast.NodeVisitor):
    """Collects the places that statements of a module use."""

    def __init__(self, package, module):
        self.package, self.module = package, module
        self.scopes, self.found, self.handed = [], set(), set()
        self.asked, self.texts = set(), set()

    def of(self, statements):
        for node in statements:
            self.visit(node)
        return self.found

    def name(self, name):
        """Place or module that a name stands for."""
        for scope in reversed(self.scopes):
            if name in scope:
                return scope[name] and self.package.follow(scope[name])
        return self.package.find(self.module.name, name)

    def resolved(self, node):
        """Place or module that a name or an attribute of a module stands for."""
        if isinstance(node, ast.Name):
            return self.name(node.id)
        if isinstance(node, ast.Attribute):
            base = self.resolved(node.value)
            if isinstance(base, str):
                return self.package.find(base, node.attr) or self.package.follow((base, node.attr))
        return None

    def use(self, found):
        if isinstance(found, str):
            self.handed.add(found)
            found = found, BODY
        if found is not None:
            self.found.add(found)

    def visit_Name(self, node):
        if isinstance(node.ctx, ast.Load):
            self.use(self.name(node.id))

    def visit_Attribute(self, node):
        found = self.resolved(node)
        if found is None:
            self.asked.add(node.attr)
            self.visit(node.value)
        else:
            self.use(found)

    def visit_Import(self, node):
        for name, source in imported(node, self.module).items():
            if self.scopes:
                self.scopes[-1][name] = source
            whole = source if isinstance(source, str) else ".".join(source)
            home = source if isinstance(source, str) else source[0]
            for one in (whole, home):
                if one in self.package.modules:
                    self.found.add((one, BODY))

    visit_ImportFrom = visit_Import

    def visit_function(self, node):
        told = getattr(node, "decorator_list", ()), (node.args, getattr(node, "returns", None))
        for part in filter(None, (*told[0], *told[1])):
            self.visit(part)
        self.scopes.append(dict.fromkeys(bound(node)))
        body = node.body if isinstance(node.body, list) else [node.body]
        for inner in body:
            for one in ast.walk(inner):
                if isinstance(one, ast.Import | ast.ImportFrom):
                    self.visit(one)
        self.of(body)
        self.scopes.pop()

    visit_FunctionDef = visit_AsyncFunctionDef = visit_Lambda = visit_function

    def visit_comprehension_of(self, node):
        names = {
            n.id for g in node.generators for n in ast.walk(g.target) if isinstance(n, ast.Name)
        }
        self.scopes.append(dict.fromkeys(names))
        self.generic_visit(node)
        self.scopes.pop()

    visit_ListComp = visit_SetComp = visit_DictComp = visit_comprehension_of
    visit_GeneratorExp = visit_comprehension_of

    def visit_Constant(self, node):
        if isinstance(node.value, str):
            self.place(node.value)
            self.texts |= {node.value} if node.value.isidentifier() else set()

    def visit_JoinedStr(self, node):
        self.place("".join(map(self.text, node.values)))
        self.generic_visit(node)

    def text(self, node):
        """What a part of a formatted text says, if a constant of the module says it."""
        if isinstance(node, ast.Constant):
            return str(node.value)
        named = isinstance(node, ast.FormattedValue) and isinstance(node.value, ast.Name)
        for made in self.module.parts.get(node.value.id, ()) if named else ():
            if isinstance(made, ast.Assign) and isinstance(made.value, ast.Constant):
                return str(made.value.value)
        return "?"

    def place(self, text):
        if PLACE.fullmatch(text):
            self.use(self.package.follow(tuple(text.split(":"))))
        elif "." in text:
            self.use(self.package.follow(text))
