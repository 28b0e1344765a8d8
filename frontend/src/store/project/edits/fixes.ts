import type { Fix, Making } from '@/model/fixes';
import { createAction } from './actionTemplate';
import { useProjectStore } from '../index';
import { actionPath, treePath } from '../state';

const store = () => useProjectStore.getState();

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

/**
 * Applies a fix. If the fix created a file, returns a function that removes the file; changes of the tree are
 * undone as usual.
 */
export function applyFix(tree: string, { does }: Fix): (() => void) | null {
  if (typeof does !== 'function') return make(does);
  store().apply(tree, 'fix', [does]);
  return null;
}
