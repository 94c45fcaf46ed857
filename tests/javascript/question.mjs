// What the pages of browser_test.py ask. The answer is `window.answer`: numbers to compare, and times in milliseconds.
const corners = [[-1, -1, -1], [-1, -1, 1], [-1, 1, -1], [-1, 1, 1], [1, -1, -1], [1, -1, 1], [1, 1, -1], [1, 1, 1]];
const faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
const [start, goal] = [[5, 0, 0], [0.5, 0, 0, 1, 0.2, 0.1, 0]];

/** `workers`: options of Chasles.workers, if workers are to answer, too. */
export async function ask(load, options, workers) {
  try {
    const began = performance.now();
    const chasles = await load(options);
    const loaded = performance.now();
    const cube = chasles.polyhedron(corners, faces);
    const { verdict, time, contacts } = chasles.firstContact(cube, cube, start, goal);
    const answered = performance.now();
    window.answer = { verdict, time, kind: contacts[0].kind, load: loaded - began, ready: answered, refusal: refusalOf(chasles) };
    if (workers) await askWorkers(chasles, cube, workers);
  } catch (error) {
    window.answer = { error: `${error.name}: ${error.message}` };
  }
  window.isDone = true;
}

function refusalOf(chasles) {
  try {
    return chasles.firstContact({}, {}, start, goal).verdict;
  } catch (error) {
    return `${error.name}: ${error.message}`;
  }
}

async function askWorkers(chasles, cube, options) {
  const workers = await chasles.workers({ count: 2, ...options });
  const answers = await workers.firstContactBatch(cube, cube, Array(9).fill(start), Array(9).fill(goal));
  workers.stop();
  window.answer.byWorkers = answers.map(({ time }) => time);
}
