import { api } from '@/api/client';
import type { TestOutcome } from '@/api/types';
import { useProjectStore } from '@/store/project';
import { useRunStore } from '@/store/run/store';
import { saveNow } from '@/store/saving/autosave';

/** What became of a test that was tried before it is written. */
export type Trial =
  | { readonly outcome: TestOutcome['outcome']; readonly reason: string }
  | { readonly outcome: 'unread'; readonly reason: string };

/** Saves the project, and runs a file of tests that is not stored yet; returns what became of one of them. */
export async function tryTest(path: string, text: string, name: string): Promise<Trial> {
  const { projectId } = useProjectStore.getState();
  if (projectId === null) throw new Error('No project is open.');
  await saveNow();
  const { tests, problems } = await api.test(projectId, [{ path, content: text }]);
  const test = tests.find((each) => each.file === path && each.name === name);
  if (!test) {
    const found = problems.find(({ file }) => file === path);
    return { outcome: 'unread', reason: [found?.message, found?.hint].filter(Boolean).join(': ') };
  }
  const [first] = test.failures;
  const where = first?.node ? `${first.node}: ` : '';
  return { outcome: test.outcome, reason: first ? `${where}${first.message}` : '' };
}

/** Writes the file as one step of the tree in front; returns a function that takes it back. */
export function writeTest(path: string, text: string): () => void {
  const { activeTree, mainTree, apply } = useProjectStore.getState();
  const tree = activeTree ?? mainTree;
  besideTheProgram(() => apply(tree, 'momentTest', [], { files: { [path]: text } }));
  return () => besideTheProgram(() => useProjectStore.getState().undo(tree));
}

/** Makes a change that is no part of the program, so that a running one stays up to date. */
function besideTheProgram(change: () => void): void {
  const counter = () => useProjectStore.getState().changeCounter;
  const isUpToDate = useRunStore.getState().ranAt === counter();
  change();
  if (isUpToDate) useRunStore.setState({ ranAt: counter() });
}
