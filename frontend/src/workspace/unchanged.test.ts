import { expect, it } from 'vitest';

/** Keys of the browser's storage: if one were renamed, users would lose drafts, layouts or settings. */
const STORAGE_KEYS = [
  "'bts.attach.address'",
  "'bts.codeSize'",
  "'bts.compactTrees'",
  "'bts.formatOnSave'",
  "'bts.guide'",
  "'bts.hints'",
  "'bts.keep3d'",
  "'bts.language'",
  "'bts.layout.'",
  "'bts.lessons'",
  "'bts.run.'",
  "'bts.start.folded'",
  "'bts.statusRate'",
  "'bts.view'",
  "'bts.viewer'",
  "'bts.xml.metadata'",
  '`bts.breakpoints.${user}.${projectId}`',
  '`bts.draft.${projectId}`',
  '`bts.followRunning.${projectId}`',
  '`bts.layout.${VERSION}.${width}`',
  '`bts.lines.${user}.${projectId}`',
  '`bts.open.${projectId}`',
  '`bts.values.${projectId}`',
  '`bts.xml.${projectId}.${treeId}`',
];
const PANELS = [
  'blackboard',
  'breakpoints',
  'camera',
  'console',
  'evaluate',
  'explorer',
  'history',
  'inspector',
  'lesson',
  'library',
  'outline',
  'palette',
  'problems',
  'profile',
  'search',
  'tests',
  'timeline',
  'topics',
  'video',
  'viewer3d',
  'xml',
];
const DOCUMENTS = ['compare', 'file', 'past', 'source', 'tree'];

const sources = import.meta.glob<string>(['../**/*.{ts,tsx}', '!../**/*.test.{ts,tsx}'], {
  query: '?raw',
  import: 'default',
  eager: true,
});

const found = (text: string, pattern: RegExp): string[] =>
  [...new Set(Array.from(text.matchAll(pattern), (match) => match[1] ?? match[0]))].sort();

it("keeps the names of the browser's storage keys", () => {
  expect(found(Object.values(sources).join('\n'), /['`]bts\.[^'`]*['`]/g)).toEqual([...STORAGE_KEYS].sort());
});

it('keeps the kinds of tabs in stored layouts', () => {
  const layout = sources['./layoutModel.ts'] ?? '';
  const panelIds = layout.slice(layout.indexOf('export type PanelId'));
  expect(found(panelIds.slice(0, panelIds.indexOf(';')), /'(\w+)'/g)).toEqual(PANELS);
  expect(found(sources['./documents.ts'] ?? '', /kind: '(\w+)'/g)).toEqual(DOCUMENTS);
});
