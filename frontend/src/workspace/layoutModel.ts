import {
  Actions,
  DockLocation,
  Model,
  type IJsonModel,
  type IJsonTabNode,
  type IJsonTabSetNode,
} from 'flexlayout-react';
import { useViewMode, type ViewMode } from '@/store/viewMode';

/** The panels; their names are texts of `frame:panel`. */
export type PanelId =
  | 'explorer'
  | 'search'
  | 'outline'
  | 'palette'
  | 'library'
  | 'inspector'
  | 'blackboard'
  | 'viewer3d'
  | 'video'
  | 'camera'
  | 'console'
  | 'problems'
  | 'tests'
  | 'evaluate'
  | 'timeline'
  | 'breakpoints'
  | 'profile'
  | 'topics'
  | 'history'
  | 'xml'
  | 'lesson';

/** Panels that stored layouts may lack, each with the panel beside which it is added. */
const NEW_PANELS: readonly (readonly [PanelId, PanelId])[] = [
  ['timeline', 'console'],
  ['tests', 'problems'],
  ['evaluate', 'tests'],
  ['topics', 'console'],
  ['library', 'palette'],
  ['history', 'explorer'],
  ['search', 'explorer'],
];

/** Panels that can have their own window, grouped by kind; all of them show the run. */
const LOOKING: readonly (readonly PanelId[])[] = [
  ['viewer3d', 'video', 'camera'],
  ['console', 'timeline', 'topics'],
  ['blackboard'],
];
/** The panels that can have their own window. */
export const WINDOWED: readonly PanelId[] = LOOKING.flat();
const NEIGHBOURS: readonly PanelId[] = ['problems', 'inspector', 'explorer'];

/** The panels that no layout has before they are used. */
export const UNTIL_USED = ['breakpoints', 'profile'] as const satisfies readonly PanelId[];

/** Returns the panels beside which a panel fits, the most similar first. */
export const companionsOf = (id: PanelId): readonly PanelId[] => [
  ...(LOOKING.find((kind) => kind.includes(id)) ?? []).filter((other) => other !== id),
  ...NEIGHBOURS,
];

/** Returns the docking options of a panel that can have its own window. */
const windowed = (id: PanelId): Partial<IJsonTabNode> =>
  WINDOWED.includes(id)
    ? // A WebGL canvas cannot move between documents, so it is created again in the other one.
      { enablePopout: true, enablePopoutIcon: true, enableWindowReMount: id === 'viewer3d' }
    : {};

export type FrameWidth = 'wide' | 'narrow';

/** The id of the tab set for documents, which stays even when it is empty. */
export const EDITORS = 'editors';

/**
 * The version of the default layout. Raise it when the default changes, so that stored layouts are dropped.
 */
const VERSION = 1;
function storageKey(width: FrameWidth, mode: ViewMode): string {
  const key = `bts.layout.${VERSION}.${width}`;
  return mode === 'basic' ? `${key}.basic` : key;
}

const panel = (id: PanelId): IJsonTabNode => ({
  type: 'tab',
  id,
  name: `panel.${id}`,
  component: id,
  enableClose: false,
  ...windowed(id),
});

/** Returns a second tab for a panel that is already open, with an id of its own; the user can close it. */
export const furtherPanel = (component: PanelId, id: string): IJsonTabNode => ({
  ...panel(component),
  id,
  enableClose: true,
});

const tabset = (id: string, weight: number, panels: PanelId[], selected = 0): IJsonTabSetNode => ({
  type: 'tabset',
  id,
  weight,
  selected: panels.length === 0 ? -1 : selected,
  enableDeleteWhenEmpty: id !== EDITORS,
  children: panels.map(panel),
});

const global: NonNullable<IJsonModel['global']> = {
  tabEnableRename: false,
  tabEnablePopout: false,
  tabSetEnableTabScrollbar: true,
  tabSetMinHeight: 80,
  tabSetMinWidth: 120,
};

/** Opens or closes an optional panel, such as the XML beside the canvas. */
export function toggleBeside(model: Model, width: FrameWidth, id: PanelId): void {
  if (model.getNodeById(id)) {
    model.doAction(Actions.deleteTab(id));
    return;
  }
  const tab = { ...panel(id), enableClose: true };
  const below = width === 'narrow' ? model.getNodeById('viewer3d')?.getParent() : undefined;
  if (below) model.doAction(Actions.addTab(tab, below.getId(), DockLocation.CENTER, -1, true));
  else model.doAction(Actions.addTab(tab, EDITORS, DockLocation.RIGHT, -1, true));
}

/** The panel beside which one that a layout lacks is opened, once it is used. */
const HOMES: Partial<Record<PanelId, PanelId>> = {
  explorer: 'palette',
  search: 'palette',
  outline: 'palette',
  history: 'palette',
  library: 'palette',
  tests: 'problems',
  evaluate: 'problems',
  timeline: 'problems',
  topics: 'problems',
  breakpoints: 'console',
  profile: 'console',
  blackboard: 'inspector',
  camera: 'video',
  lesson: 'inspector',
};

function addMissing(model: Model, id: PanelId, isInFront: boolean): void {
  const beside = model.getNodeById(HOMES[id] ?? '')?.getParent();
  if (!beside || model.getNodeById(id)) return;
  const tab = { ...panel(id), enableClose: true };
  model.doAction(Actions.addTab(tab, beside.getId(), DockLocation.CENTER, -1, isInFront));
}

/** Opens a panel that the layout lacks, if there is a place for it. */
export const openMissing = (model: Model, id: PanelId): void => addMissing(model, id, true);

/** Adds a panel that the layout lacks, behind the one that is open at its place. */
export const addBehind = (model: Model, id: PanelId): void => addMissing(model, id, false);

/** Returns the layout of a first project: blocks, tree, output, robot and properties. */
function basicLayout(width: FrameWidth, view: number): IJsonModel {
  const views: PanelId[] = ['viewer3d', 'video'];
  const output: PanelId[] = ['console', 'problems'];
  if (width === 'narrow') {
    const panels = tabset('panels', 45, [...views, 'inspector', 'palette', ...output], view);
    const children = [tabset(EDITORS, 55, []), panels];
    return { global: { ...global, rootOrientationVertical: true }, layout: { type: 'row', children } };
  }
  const middle = [tabset(EDITORS, 78, []), tabset('output', 22, output)];
  const right = [tabset('views', 50, views, view), tabset('details', 50, ['inspector'])];
  return {
    global,
    layout: {
      type: 'row',
      children: [
        tabset('nodes', 15, ['palette']),
        { type: 'row', weight: 55, children: middle },
        { type: 'row', weight: 30, children: right },
      ],
    },
  };
}

function defaultLayout(width: FrameWidth, hasWebGl: boolean, mode: ViewMode): IJsonModel {
  const view = hasWebGl ? 0 : 1;
  if (mode === 'basic') return basicLayout(width, view);
  if (width === 'narrow') {
    return {
      global: { ...global, rootOrientationVertical: true },
      layout: {
        type: 'row',
        children: [
          tabset(EDITORS, 55, []),
          tabset(
            'panels',
            45,
            [
              'viewer3d',
              'video',
              'camera',
              'inspector',
              'palette',
              'library',
              'console',
              'problems',
              'tests',
              'evaluate',
              'timeline',
              'topics',
              'blackboard',
              'explorer',
              'search',
              'outline',
              'history',
            ],
            view,
          ),
        ],
      },
    };
  }
  return {
    global,
    layout: {
      type: 'row',
      children: [
        {
          type: 'row',
          weight: 17,
          children: [
            tabset('files', 42, ['explorer', 'outline', 'search', 'history']),
            tabset('nodes', 58, ['palette', 'library']),
          ],
        },
        {
          type: 'row',
          weight: 53,
          children: [
            tabset(EDITORS, 74, []),
            tabset('output', 26, ['console', 'problems', 'tests', 'evaluate', 'timeline', 'topics']),
          ],
        },
        {
          type: 'row',
          weight: 30,
          children: [
            tabset('views', 50, ['viewer3d', 'video', 'camera'], view),
            tabset('details', 50, ['inspector', 'blackboard']),
          ],
        },
      ],
    },
  };
}

/** Returns the layout of a page that follows a program: what tells of a tree, without what changes one. */
export function attachedLayout(width: FrameWidth): Model {
  const below: PanelId[] = ['timeline', 'console', 'breakpoints'];
  const beside: PanelId[] = ['inspector', 'blackboard'];
  if (width === 'narrow') {
    return Model.fromJson({
      global: { ...global, rootOrientationVertical: true },
      layout: {
        type: 'row',
        children: [tabset(EDITORS, 55, []), tabset('panels', 45, [...beside, ...below, 'outline'])],
      },
    });
  }
  return Model.fromJson({
    global,
    layout: {
      type: 'row',
      children: [
        tabset('files', 17, ['outline']),
        { type: 'row', weight: 55, children: [tabset(EDITORS, 74, []), tabset('output', 26, below)] },
        {
          type: 'row',
          weight: 28,
          children: [tabset('details', 55, ['inspector']), tabset('values', 45, ['blackboard'])],
        },
      ],
    },
  });
}

interface KeptNode {
  readonly id?: string;
  readonly config?: { readonly document?: boolean };
  readonly children?: readonly KeptNode[];
}

/**
 * Returns whether a tab belongs to the project, as documents and the lesson do; the other panels belong to
 * the user's layout.
 */
const isOfProject = ({ id, config }: KeptNode): boolean => config?.document === true || id === 'lesson';

/** Returns whether a node contains only a lesson: then its set of tabs is removed too. */
const isForLesson = ({ children = [] }: KeptNode): boolean =>
  children.length > 0 && children.every(({ id }) => id === 'lesson');

/** Returns the layout without the tabs that belong to a project. */
function withoutDocuments(json: IJsonModel): IJsonModel {
  const text = JSON.stringify(json, (key, value: unknown) => {
    if (key !== 'children' || !Array.isArray(value)) return value;
    return value.filter((child: KeptNode) => !isOfProject(child) && !isForLesson(child));
  });
  const copy = JSON.parse(text) as IJsonModel;
  resetSelection(copy.layout as LayoutNode);
  return copy;
}

interface LayoutNode {
  id?: string;
  type?: string;
  selected?: number;
  children?: LayoutNode[];
  maximized?: boolean;
}

function resetSelection(node: LayoutNode): void {
  const count = node.children?.length ?? 0;
  if (node.type === 'tabset' && (node.selected ?? 0) >= count) node.selected = count - 1;
  delete node.maximized;
  node.children?.forEach(resetSelection);
}

/** Returns the user's layout for the present view mode, or the default one. */
export function loadLayout(width: FrameWidth, hasWebGl: boolean): Model {
  const { mode } = useViewMode.getState();
  const kept = localStorage.getItem(storageKey(width, mode));
  if (kept) {
    try {
      const model = Model.fromJson(JSON.parse(kept) as IJsonModel);
      const whole = mode === 'full' ? withNewPanels(model) : model;
      if (model.getNodeById(EDITORS)) return withAttributes(whole);
    } catch {
      // An unreadable layout is replaced by the default one.
    }
  }
  return Model.fromJson(defaultLayout(width, hasWebGl, mode));
}

/** Adds the panels that a stored layout lacks, beside their neighbours. */
function withNewPanels(model: Model): Model {
  for (const [id, neighbour] of NEW_PANELS) {
    const beside = model.getNodeById(neighbour)?.getParent();
    if (!beside || model.getNodeById(id)) continue;
    model.doAction(Actions.addTab(panel(id), beside.getId(), DockLocation.CENTER, -1, false));
  }
  return model;
}

/** Updates a layout that was stored when panels could not have windows yet, or none of them be closed. */
function withAttributes(model: Model): Model {
  const changes: [PanelId, Partial<IJsonTabNode>][] = [
    ...WINDOWED.map((id): [PanelId, Partial<IJsonTabNode>] => [id, windowed(id)]),
    ...UNTIL_USED.map((id): [PanelId, Partial<IJsonTabNode>] => [id, { enableClose: true }]),
  ];
  for (const [id, attributes] of changes) {
    if (model.getNodeById(id)) model.doAction(Actions.updateNodeAttributes(id, attributes));
  }
  return model;
}

export function keepLayout(width: FrameWidth, mode: ViewMode, model: Model): void {
  localStorage.setItem(storageKey(width, mode), JSON.stringify(withoutDocuments(model.toJson())));
}

export function forgetLayouts(): void {
  for (const mode of ['basic', 'full'] as const) {
    localStorage.removeItem(storageKey('wide', mode));
    localStorage.removeItem(storageKey('narrow', mode));
  }
}
