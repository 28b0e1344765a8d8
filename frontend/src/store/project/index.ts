import { create } from 'zustand';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { produce, type Draft } from 'immer';
import { renameUse } from '@/model/edits';
import { emptyUndo, redo, seal, undo, type Renaming, type Travel } from '@/model/undo';
import { applySaved, currentText, openFiles, pendingChanges, tryParse } from './files';
import { renamed as tellNavigator } from './navigation';
import { whileEditing } from './problems';
import { refusingViewers } from './readOnly';
import { readSettings } from './settings';
import { withActionRenamed } from './edits/renameAction';
import { withFilesOfStep } from './writtenFiles';
import { actionPath, treeIdOf, type ProjectData, type ProjectState } from './state';
import {
  actionsAfter,
  changeDiagrams,
  confirmed,
  findingsAfter,
  initialData,
  knowing,
  removeFile,
  type Change,
  type ChangeOptions,
  type Diagrams,
} from './transitions';

/** Renames the tab of a renamed action. */
const tellRenamed = ({ from, to }: Renaming): void => {
  tellNavigator('file', actionPath(from), actionPath(to));
};

/** The saved data of the open project, and the selection. */
export const useProjectStore = create<ProjectState>()((setState, get) => {
  const set = refusingViewers(setState);
  /** Records a change of trees as one step on the undo stack of `owner`. */
  const commit = (owner: string, label: string, change: Change, options: ChangeOptions = {}): void => {
    set((state) => changeDiagrams(state, owner, label, change, options));
  };

  const travel = (go: typeof undo, tree?: string): void => {
    let followed: Renaming | null = null;
    set((state) => {
      const owner = tree ?? state.activeTree;
      if (owner === null) return state;
      const undoStack = state.histories[owner] ?? emptyUndo;
      let moved: Travel<Diagrams> | null;
      try {
        moved = go(state.diagrams, undoStack);
      } catch {
        // The step refers to a node that an edit of another tree has removed, so it cannot be replayed.
        return { histories: { ...state.histories, [owner]: emptyUndo } };
      }
      if (!moved) return state;
      const { renamed } = moved.entry;
      const renaming = renamed && go === undo ? { from: renamed.to, to: renamed.from } : renamed;
      const files = renaming ? withActionRenamed(state, renaming) : null;
      if (files) followed = renaming ?? null;
      const chosen =
        owner !== state.activeTree ? state.selection : go === undo ? moved.entry.before : moved.entry.after;
      const diagram = moved.document[state.activeTree ?? owner];
      const data = withFilesOfStep(
        { ...(files ?? state), diagrams: moved.document },
        moved.entry,
        go === undo ? 'undo' : 'redo',
      );
      return {
        ...knowing(data),
        histories: { ...data.histories, [owner]: moved.undoStack },
        selection: chosen.filter((id) => diagram !== undefined && id in diagram.nodes),
        changeCounter: state.changeCounter + 1,
      };
    });
    if (followed) tellRenamed(followed);
  };

  const renameEverywhere =
    (kind: 'action' | 'tree', from: string, to: string): Change =>
    (draft) => {
      for (const diagram of Object.values(draft)) renameUse(kind, from, to)(diagram);
    };

  return {
    ...initialData,

    load: (detail) => {
      const opened = openFiles(detail.files);
      const settings = readSettings(detail);
      const main = settings.main_tree;
      const data: ProjectData = {
        ...initialData,
        ...opened,
        projectId: detail.id,
        role: detail.role ?? 'owner',
        name: detail.name,
        description: detail.description,
        settings,
        mainTree: main,
        revision: detail.revision,
        actions: detail.actions,
        diagnostics: whileEditing(detail.diagnostics),
        rosDistro: detail.ros_distro ?? null,
        activeTree: main in opened.diagrams ? main : (Object.keys(opened.diagrams)[0] ?? null),
      };
      set(knowing(data));
    },
    close: () => {
      set(initialData);
    },

    setActiveTree: (id) => {
      set((state) => (state.activeTree === id ? state : { activeTree: id, selection: [] }));
    },
    select: (treeId, ids) => {
      set((state) => {
        const same =
          state.activeTree === treeId &&
          state.selection.length === ids.length &&
          ids.every((id, index) => state.selection[index] === id);
        if (same) return state;
        const undoStack = state.histories[treeId];
        return {
          activeTree: treeId,
          selection: ids,
          ...(undoStack ? { histories: { ...state.histories, [treeId]: seal(undoStack) } } : {}),
        };
      });
    },
    reveal: (tree, node) => {
      set((state) => ({
        activeTree: tree,
        selection: [node],
        revealed: { tree, node, count: (state.revealed?.count ?? 0) + 1 },
      }));
    },

    apply: (treeId, label, recipes, options = {}) => {
      commit(
        treeId,
        label,
        (draft) => {
          const diagram = draft[treeId];
          if (!diagram) return;
          for (const recipe of recipes) recipe(diagram);
          for (const [id, other] of Object.entries(options.also ?? {})) {
            if (other) draft[id] = other as Draft<Diagram>;
            else Reflect.deleteProperty(draft, id);
          }
        },
        options,
      );
    },
    seal: (treeId) => {
      set((state) => {
        const owner = treeId ?? state.activeTree;
        const undoStack = owner === null ? undefined : state.histories[owner];
        return owner !== null && undoStack
          ? { histories: { ...state.histories, [owner]: seal(undoStack) } }
          : state;
      });
    },
    undo: (tree) => {
      travel(undo, tree);
    },
    redo: () => {
      travel(redo);
    },

    addTree: (id) => {
      set((state) => {
        if (id in state.diagrams) return state;
        const diagrams = { ...state.diagrams, [id]: emptyDiagram(id) };
        return { ...knowing({ ...state, diagrams }), changeCounter: state.changeCounter + 1 };
      });
    },
    renameTree: (from, to) => {
      const state = get();
      const diagram = state.diagrams[from];
      if (!diagram || to in state.diagrams) return;
      const renamed = produce(state.diagrams, renameEverywhere('tree', from, to));
      const { [from]: moved = diagram, ...others } = renamed;
      const diagrams = { ...others, [to]: { ...moved, id: to } };
      // This comes before the old name is removed, since tabs of missing trees are closed.
      if (state.role !== 'viewer') tellNavigator('tree', from, to);
      const { [from]: _undoStack, ...histories } = state.histories;
      set({
        ...knowing({ ...state, diagrams }),
        histories: { ...histories, [to]: emptyUndo },
        activeTree: state.activeTree === from ? to : state.activeTree,
        selection: state.selection,
        changeCounter: state.changeCounter + 1,
      });
      if (state.mainTree === from) get().setSettings({ main_tree: to });
    },
    deleteTree: (id) => {
      set((state) => {
        const { [id]: _gone, ...diagrams } = state.diagrams;
        const { [id]: _undoStack, ...histories } = state.histories;
        return {
          ...knowing({ ...state, diagrams }),
          histories,
          activeTree: state.activeTree === id ? (Object.keys(diagrams)[0] ?? null) : state.activeTree,
          selection: state.activeTree === id ? [] : state.selection,
          changeCounter: state.changeCounter + 1,
        };
      });
    },
    renameAction: (from, to) => {
      const renamed = { from, to };
      const next = withActionRenamed(get(), renamed);
      if (!next) return;
      set(() => knowing(next));
      if (!(actionPath(to) in get().files)) return;
      tellRenamed(renamed);
      const owner = get().activeTree ?? Object.keys(get().diagrams)[0];
      if (owner !== undefined)
        commit(owner, 'renameAction', renameEverywhere('action', from, to), { renamed });
    },

    setFileText: (path, text) => {
      const id = treeIdOf(path);
      const diagram = id === null ? null : tryParse(id, text);
      if (id !== null && diagram) {
        commit(
          id,
          'editText',
          (draft) => {
            draft[id] = diagram as Draft<Diagram>;
          },
          { mergeKey: 'text' },
        );
        return;
      }
      set((state) => {
        const entry = state.files[path];
        if (!entry || entry.text === text) return state;
        const kind = entry.kind === 'large' ? 'text' : entry.kind; // what the server has is loaded no more
        return {
          files: { ...state.files, [path]: { ...entry, kind, text } },
          changeCounter: state.changeCounter + 1,
        };
      });
    },
    addFile: (path, text) => {
      const id = treeIdOf(path);
      const diagram = id === null ? null : tryParse(id, text);
      set((state) => {
        const changeCounter = state.changeCounter + 1;
        if (id !== null && diagram) {
          return { ...knowing({ ...state, diagrams: { ...state.diagrams, [id]: diagram } }), changeCounter };
        }
        const { [path]: revision = 0, ...removed } = state.removed;
        const entry = { path, kind: 'text', text, revision, savedText: null } as const;
        return { files: { ...state.files, [path]: entry }, removed, changeCounter };
      });
    },
    deleteFile: (path) => {
      const id = treeIdOf(path);
      if (id !== null && get().diagrams[id]) get().deleteTree(id);
      else set((state) => removeFile(state, path));
    },
    setSettings: (patch) => {
      const settings = get().settings;
      if (!settings || get().role === 'viewer') return;
      const next = { ...settings, ...patch };
      set((state) => knowing({ ...state, settings: next, mainTree: next.main_tree, name: next.name }));
      get().setFileText('project.json', `${JSON.stringify(next, null, 2)}\n`);
    },

    setChecked: (result) => {
      set((state) => {
        const { diagnostics, actions, rosDistro } = findingsAfter(state, result);
        return knowing({
          ...state,
          rosDistro,
          diagnostics: confirmed(state.diagnostics, diagnostics),
          actions: confirmed(state.actions, actions),
        });
      });
    },
    pendingChanges: () => pendingChanges(get()),
    applySaved: (sent, result) => {
      set((state) => {
        const saved = applySaved(state, sent, result);
        const { diagnostics, actions, rosDistro } = findingsAfter(state, result);
        return knowing({
          ...state,
          ...saved,
          rosDistro,
          revision: result.revision,
          actions: actionsAfter(state.actions, actions, saved.files),
          diagnostics: confirmed(state.diagnostics, whileEditing(diagnostics)),
        });
      });
    },
    rebase: (path, revision, savedText) => {
      set((state) => {
        const entry = state.files[path];
        if (!entry) return state;
        return {
          files: { ...state.files, [path]: { ...entry, revision, savedText } },
          changeCounter: state.changeCounter + 1,
        };
      });
    },
    currentText: (path) => currentText(get(), path),
  };
});
