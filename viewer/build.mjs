// Makes the page without a scene: page_template.html, and page_template.cpp with the same text in C++
// (view/page_template.h).
import { build, transform } from "esbuild";
import { readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

const here = (file) => new URL(file, import.meta.url);
const text = (file) => readFileSync(here(file), "utf8");

async function bundledScript() {
  const result = await build({
    entryPoints: [fileURLToPath(here("src/main.ts"))],
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2022",
    charset: "ascii",
    legalComments: "none", // the page contains the whole licence of three.js instead
    write: false,
  });
  return result.outputFiles[0].text;
}

async function page() {
  const style = await transform(text("src/style.css"), { loader: "css", minify: true });
  const parts = {
    LICENCES: `three.js\n\n${text("node_modules/three/LICENSE")}`,
    STYLE: style.code.trim(),
    SCRIPT: (await bundledScript()).trim(),
  };
  return text("src/page.html").replace(/@(LICENCES|STYLE|SCRIPT)@/g, (_, name) => parts[name].trim());
}

// String literals of at most 8,000 characters, which every compiler accepts. The escape of "?" prevents trigraphs.
function literals(content) {
  const pieces = [];
  for (let at = 0; at < content.length; at += 8000) {
    const escaped = content.slice(at, at + 8000).replace(/[\\"?]/g, "\\$&").replace(/\n/g, "\\n").replace(/\t/g, "\\t");
    pieces.push(`    "${escaped}"sv,`);
  }
  return pieces.join("\n");
}

function source(content) {
  return `// Made by viewer/build.mjs.
#include "view/page_template.h"

namespace chasles::view {

using namespace std::string_view_literals;

std::span<const std::string_view> page_template() {
  static constexpr std::string_view pieces[] = {
${literals(content)}
  };
  return pieces;
}

std::string_view why_no_page_template() {
  return {};
}

} // namespace chasles::view
`;
}

function check(content) {
  const problems = [
    [/[^\t\n\x20-\x7e\u00a9]/.test(content), "a character outside the supported set"],
    [content.split("@CHASLES_SCENE@").length !== 2, "not exactly one marker for the scene"],
    [content.split("</script>").length !== 3, "a script that contains </script>"],
  ];
  for (const [isWrong, what] of problems) if (isWrong) throw new Error(`page_template.html: ${what}`);
}

const content = await page();
check(content);
writeFileSync(here("page_template.html"), content);
writeFileSync(here("page_template.cpp"), source(content));
