import { fixesFor, type Fix, type Making } from '@/model/fixes';
import { CODES, findProblems } from '@/model/problems';
import type { Diagnostic } from '@/api/types';
import { createAction } from './actionTemplate';
import { useProjectStore } from '../index';
import { actionPath, treePath } from '../state';

const store = () => useProjectStore.getState();

/** The fixes of a server finding: those of the same finding of the editor, if there is one. */
export function fixesOfDiagnostic(item: Diagnostic): Fix[] {
  const { diagrams, vocabulary } = store();
  const diagram = diagrams[item.tree ?? ''];
  if (!diagram || !item.node) return [];
  const own = findProblems(diagram, vocabulary).find(
    (each) =>
      each.node === item.node &&
      (each.port ?? '') === (item.port ?? '') &&
      CODES[each.kind].includes(item.code),
  );
  const port = item.port ? { port: item.port } : {};
  return fixesFor(own ?? { code: item.code, node: item.node, ...port }, diagram, vocabulary);
}

function make(making: Making): () => void {
  const path = making.makes === 'action' ? actionPath(making.name) : treePath(making.name);
  if (making.makes === 'tree') store().addTree(making.name);
  else createAction(making.name, making.kind ?? 'Action', making.ports);
  return () => {
    store().deleteFile(path);
    const { actions, diagnostics, setChecked } = store();
    if (making.makes === 'action') {
      setChecked({ diagnostics, actions: actions.filter((each) => each.name !== making.name) });
    }
  };
}

/** Applies a fix. The returned function removes a file that it created; undo reverts the tree. */
export function applyFix(tree: string, { does }: Fix): (() => void) | null {
  if (typeof does !== 'function') return make(does);
  store().apply(tree, 'fix', [does]);
  return null;
}
