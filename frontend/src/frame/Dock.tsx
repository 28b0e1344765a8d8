import {
  I18nLabel,
  Layout,
  type Action,
  type IIcons,
  type ITabRenderValues,
  type Model,
  type TabNode,
} from 'flexlayout-react';
import { IconChevronsDown, IconFileCode, IconFileText, IconGitFork, IconHistory } from '@tabler/icons-react';
import { useCallback, useEffect, useMemo, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import 'flexlayout-react/style/light.css';
import './dock.css';
import { t, translates } from '@/i18n';
import { useProjectStore } from '@/store/project';
import { forgetLayouts, keepLayout, type FrameWidth } from '@/workspace/layoutModel';
import { renderTab } from './panels';
import { PanelBadge } from './PanelBadge';
import { Popouts } from './popouts';
import { documentOf, followFront, keepOpen, useTabs } from '@/workspace/tabs';

const KEEP_AFTER_MS = 300;

interface DockProps {
  readonly model: Model;
  readonly width: FrameWidth;
}

function renderTabButton(node: TabNode, values: ITabRenderValues): void {
  const tab = documentOf(node);
  if (tab?.kind === 'tree') values.leading = <IconGitFork size={15} aria-hidden="true" />;
  if (tab?.kind === 'compare') values.leading = <IconHistory size={15} aria-hidden="true" />;
  if (tab?.kind === 'file') {
    values.leading = tab.path.endsWith('.py') ? (
      <IconFileCode size={15} aria-hidden="true" />
    ) : (
      <IconFileText size={15} aria-hidden="true" />
    );
  }
  if (!tab) values.buttons.push(<PanelBadge key="badge" panel={node.getId()} />);
}

/** The button of tabs that have no room: its name says what they are, and its picture how many. */
const ICONS: IIcons = {
  more: (_tabset, hidden) => (
    <>
      <IconChevronsDown size={14} aria-hidden="true" />
      <span className="flexlayout__tab_button_overflow_count" data-count={hidden.length || ''} />
    </>
  ),
};

/** What the docking library says, by its own keys. */
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

/** In the language that the page has when it asks: the library keeps this function through a change of it. */
function translated(key: string): string {
  const word = WORDS.get(key) ?? key;
  // Trees and files are called as their author wills, be it as one of our texts.
  const isOurs = word !== key || key.startsWith('panel.');
  return isOurs && translates(`frame:${word}`) ? t(`frame:${word}`) : word;
}

/** Does the last of many things a moment later, or at once when the page goes; nothing once the panels are gone. */
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

/** The panels, docked as the user likes them. */
export function Dock({ model, width }: DockProps) {
  useTranslation('frame');
  const keepSoon = useLater();

  const popouts = useMemo(() => new Popouts(model), [model]);

  const onModelChange = (changed: Model, _action: Action) => {
    followFront(changed);
    const { projectId } = useProjectStore.getState();
    keepSoon(() => {
      keepLayout(width, changed);
      if (projectId) keepOpen(projectId, changed);
    });
  };

  return (
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
  );
}

/** Puts every panel back where it was the first time. */
export function resetLayout(): void {
  forgetLayouts();
  useTabs.setState({ model: null });
}
