import type { ProjectDetail, ProjectFile } from '@/api/types';

/** Returns a file in the server's format. */
export const projectFile = (path: string, revision: number, content: string): ProjectFile => ({
  path,
  revision,
  size: content.length,
  sha256: '',
  updated_at: '',
  content,
});

/** Returns a diagram of one block. */
export const oneBlock = (tree: string, type: string): string =>
  JSON.stringify({
    format: 'bt-studio/diagram',
    version: 1,
    id: tree,
    root: 'n1',
    nodes: { n1: { type } },
    drafts: [],
  });

/** Returns a project in the server's format, for tests of the stores. */
export const projectDetail = (
  revision: number,
  files: readonly ProjectFile[],
  mainTree = 'MainTree',
): ProjectDetail => ({
  id: 'p1',
  name: 'Test',
  description: '',
  main_tree: mainTree,
  universe: '',
  revision,
  size: 0,
  created_at: '',
  updated_at: '',
  archived_at: null,
  deleted_at: null,
  role: 'owner',
  owner: '',
  root_diagram: null,
  conditions: [],
  settings: { name: 'Test', main_tree: mainTree },
  files: [...files],
  actions: [],
  diagnostics: [],
  checked: true,
});
