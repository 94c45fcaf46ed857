// What a bundler makes of `import wasm from "chasles/chasles.wasm"`: an address, bytes or a module, by its loader. The type is none
// in particular, so that both `load({ wasm })` and `load({ wasm: fetch(wasm) })` compile.
declare const wasm: any;
export default wasm;
