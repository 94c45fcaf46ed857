// Node.js, and its modules. Bundlers for browsers do not follow a name in a variable.
export const isNode = Boolean(globalThis.process?.versions?.node);

/** A module of Node.js, also where code is run without `import()`, as by Jest. */
export const builtin = async (name) => globalThis.process.getBuiltinModule?.(name) ?? import(/* @vite-ignore */ /* webpackIgnore: true */ name);
