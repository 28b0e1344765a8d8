import {
  I18nLabel,
  Layout,
  type Action,
  type IIcons,
  type ITabRenderValues,
  type Model,
  type TabNode,
} from 'flexlayout-react';
import {
  IconChevronsDown,
  IconFileCode,
  IconFileText,
  IconGitFork,
  IconHistory,
  IconHistoryToggle,
  IconLock,
} from '@tabler/icons-react';
import { useCallback, useEffect, useMemo, useRef, type RefObject } from 'react';
import { useTranslation } from 'react-i18next';
import 'flexlayout-react/style/light.css';
import './dock.css';
import classes from './frame.module.css';
import { t, translates } from '@/i18n';
import { useProjectStore } from '@/store/project';
import { setViewMode, useViewMode } from '@/store/viewMode';
import { forgetLayouts, keepLayout, type FrameWidth } from '@/workspace/layoutModel';
import { markCutTabs } from './cutTabs';
import { panelIcon } from './panelIcons';
import { keepLesson } from '@/workspace/lessons';
import { renderTab } from './panels';
import { cancelSplitters } from './cancelSplitters';
import { PanelBadge } from './PanelBadge';
import { Popouts, titleOf } from './popouts';
import { cameraOf } from '@/workspace/cameraViews';
import { giveRoom } from '@/workspace/room';
import {
  documentOf,
  folderOf,
  followFront,
  followWindows,
  keepOpen,
  openDocuments,
  useTabs,
} from '@/workspace/tabs';

const KEEP_AFTER_MS = 300;

interface DockProps {
  readonly model: Model;
  readonly width: FrameWidth;
  /** Whether the layout is that of the user, which is kept. */
  readonly isKept?: boolean;
}

function renderTabButton(node: TabNode, values: ITabRenderValues): void {
  const tab = documentOf(node);
  if (tab?.kind === 'tree') values.leading = <IconGitFork size={15} aria-hidden="true" />;
  if (tab?.kind === 'compare') values.leading = <IconHistory size={15} aria-hidden="true" />;
  if (tab?.kind === 'past') values.leading = <IconHistoryToggle size={15} aria-hidden="true" />;
  if (tab?.kind === 'source') values.leading = <IconLock size={15} aria-hidden="true" />;
  if (tab?.kind === 'file') {
    values.leading = tab.path.endsWith('.py') ? (
      <IconFileCode size={15} aria-hidden="true" />
    ) : (
      <IconFileText size={15} aria-hidden="true" />
    );
  }
  const folder = tab ? folderOf(tab, openDocuments(node.getModel())) : null;
  if (folder !== null) {
    const name = `${node.getName()} · ${folder}`;
    Object.assign(values, { content: name, name });
  }
  const camera = cameraOf(node);
  const title = `${titleOf(node)} · ${camera}`;
  // The library also takes the tab's accessible name from these values, although its type does not declare
  // it.
  if (camera !== null) Object.assign(values, { content: title, name: title });
  if (tab) return;
  const Icon = panelIcon(node.getComponent() ?? '');
  if (Icon) values.leading = <Icon size={16} data-panel-icon aria-hidden="true" />;
  values.buttons.push(<PanelBadge key="badge" panel={node.getId()} />);
}

/** The icons of the docking library. The button for tabs that do not fit shows their number. */
const ICONS: IIcons = {
  more: (_tabset, hidden) => (
    <>
      <IconChevronsDown size={14} aria-hidden="true" />
      <span className="flexlayout__tab_button_overflow_count" data-count={hidden.length || ''} />
    </>
  ),
};

/** The texts of the docking library: its keys, with our own. */
const WORDS: ReadonlyMap<string, string> = new Map([
  [I18nLabel.Close_Tab, 'dock.closeTab'],
  [I18nLabel.Close_Tabset, 'dock.closeTabs'],
  [I18nLabel.Active_Tabset, 'dock.active'],
  [I18nLabel.Move_Tabset, 'dock.move'],
  [I18nLabel.Move_Tabs, 'dock.move'],
  [I18nLabel.Maximize, 'dock.maximize'],
  [I18nLabel.Restore, 'dock.restore'],
  [I18nLabel.Popout_Tab, 'dock.popOut'],
  [I18nLabel.Popout_Window_Name, 'dock.window'],
  [I18nLabel.Overflow_Menu_Tooltip, 'dock.hidden'],
  [I18nLabel.Splitter, 'dock.splitter'],
  [I18nLabel.Error_rendering_component, 'dock.failed'],
  [I18nLabel.Error_rendering_component_retry, 'dock.retry'],
]);

/**
 * Translates a text of the library. It does so at each call, since the library keeps this function when the
 * language changes.
 */
function translated(key: string): string {
  const word = WORDS.get(key) ?? key;
  // Trees and files have names from the user, which may equal one of our text keys.
  const isOurs = word !== key || key.startsWith('panel.');
  return isOurs && translates(`frame:${word}`) ? t(`frame:${word}`) : word;
}

/**
 * Returns a function that delays an action. Of several actions in a row, only the last runs: after a moment,
 * or at once when the page closes. None runs after the panels are removed.
 */
function useLater(): (act: () => void) => void {
  const waiting = useRef<{ act: () => void; timer: ReturnType<typeof setTimeout> } | null>(null);
  const cancel = useCallback(() => {
    clearTimeout(waiting.current?.timer);
    waiting.current = null;
  }, []);
  const flush = useCallback(() => {
    const act = waiting.current?.act;
    cancel();
    act?.();
  }, [cancel]);
  useEffect(() => {
    window.addEventListener('pagehide', flush);
    return () => {
      window.removeEventListener('pagehide', flush);
      cancel();
    };
  }, [flush, cancel]);
  return (act) => {
    cancel();
    waiting.current = { act, timer: setTimeout(flush, KEEP_AFTER_MS) };
  };
}

/**
 * Marks bars of tabs whose names do not fit, so that they show icons, after each change of the layout, its
 * size or the language.
 */
function useCutTabs(language: string): { root: RefObject<HTMLDivElement | null>; measure: () => void } {
  const root = useRef<HTMLDivElement>(null);
  // The bars are measured after the docking library has drawn the change.
  const measure = useCallback(() => {
    requestAnimationFrame(() => {
      if (root.current) markCutTabs(root.current);
    });
  }, []);
  useEffect(() => {
    if (!root.current) return undefined;
    const observer = new ResizeObserver(measure);
    observer.observe(root.current);
    return () => observer.disconnect();
  }, [measure]);
  useEffect(measure, [measure, language]);
  return { root, measure };
}

/** The dock: panels and documents, which the user can arrange. */
export function Dock({ model, width, isKept = true }: DockProps) {
  const { i18n } = useTranslation('frame');
  const { root, measure } = useCutTabs(i18n.language);
  const keepSoon = useLater();

  useEffect(() => followWindows(model), [model]);
  const popouts = useMemo(() => new Popouts(model), [model]);
  useEffect(() => cancelSplitters(document, model), [model]);

  const onModelChange = (changed: Model, _action: Action) => {
    followFront(changed);
    followWindows(changed);
    giveRoom(changed);
    measure();
    const { projectId } = useProjectStore.getState();
    const { mode } = useViewMode.getState();
    keepSoon(() => {
      if (isKept) keepLayout(width, mode, changed);
      if (!projectId) return;
      keepOpen(projectId, changed);
      keepLesson(projectId, changed);
    });
  };

  return (
    <div ref={root} className={classes['dockRoot']}>
      <Layout
        model={model}
        factory={renderTab}
        icons={ICONS}
        onRenderTab={renderTabButton}
        onModelChange={onModelChange}
        onAction={popouts.onAction}
        onPopoutOpen={popouts.onOpen}
        onPopoutClose={popouts.onClose}
        popoutURL="/popout.html"
        i18nTranslator={translated}
        invalidateTabContentOnParentRender={false}
        realtimeResize
      />
    </div>
  );
}

/** Shows what a first project needs, or everything. Each has its own layout; documents stay open. */
export function toggleViewMode(): void {
  setViewMode(useViewMode.getState().mode === 'basic' ? 'full' : 'basic');
  useTabs.setState({ model: null });
}

/** Restores the default layout. */
export function resetLayout(): void {
  forgetLayouts();
  useTabs.setState({ model: null });
}
