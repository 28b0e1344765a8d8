import type { ActionModel, ProjectDetail } from '@/api/types';
import type { AttachedTree } from '@/generated/messages';

/** The name under which the page keeps what belongs to the program at an address, such as its breakpoints. */
export const attachedId = (address: string): string => `attached ${address}`;

/** Returns the tree of a program in the form of a project that the user can only read. */
export function detailOf(tree: AttachedTree, address: string): ProjectDetail {
  const settings = JSON.parse(tree.files['project.json'] ?? '{}') as ProjectDetail['settings'];
  return {
    id: attachedId(address),
    name: tree.name,
    description: '',
    main_tree: tree.main_tree,
    universe: '',
    revision: 1,
    size: 0,
    created_at: '',
    updated_at: '',
    archived_at: null,
    deleted_at: null,
    root_diagram: null,
    conditions: [],
    role: 'viewer',
    owner: '',
    settings,
    files: Object.entries(tree.files).map(([path, content]) => ({
      path,
      content,
      revision: 1,
      size: content.length,
      sha256: '',
      updated_at: '',
    })),
    actions: tree.actions as unknown as ActionModel[],
    diagnostics: [],
    checked: true,
  };
}
