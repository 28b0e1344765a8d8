import {
  I18nLabel,
  Layout,
  type Action,
  type ITabRenderValues,
  type Model,
  type TabNode,
} from 'flexlayout-react';
import { IconFileCode, IconFileText, IconGitFork, IconHistory } from '@tabler/icons-react';
import { useEffect, useMemo, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import 'flexlayout-react/style/light.css';
import './dock.css';
import { useProjectStore } from '@/store/project';
import { forgetLayouts, keepLayout, type FrameWidth } from './layoutModel';
import { renderTab } from './panels';
import { PanelBadge } from './PanelBadge';
import { Popouts } from './popouts';
import { followFront, keepOpen, useTabs, type DocumentTab } from './tabs';

interface DockProps {
  readonly model: Model;
  readonly width: FrameWidth;
}

function renderTabButton(node: TabNode, values: ITabRenderValues): void {
  const config = node.getConfig() as { tab?: DocumentTab } | undefined;
  const tab = config?.tab;
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

/** The panels, docked as the user likes them. */
export function Dock({ model, width }: DockProps) {
  const { t, i18n } = useTranslation('frame');
  const keeping = useRef<ReturnType<typeof setTimeout>>(undefined);
  useEffect(() => () => clearTimeout(keeping.current), []);

  const popouts = useMemo(() => new Popouts(model), [model]);

  const onModelChange = (changed: Model, _action: Action) => {
    followFront(changed);
    clearTimeout(keeping.current);
    keeping.current = setTimeout(() => {
      const { projectId } = useProjectStore.getState();
      keepLayout(width, changed);
      if (projectId) keepOpen(projectId, changed);
    }, 300);
  };

  return (
    <Layout
      model={model}
      factory={renderTab}
      onRenderTab={renderTabButton}
      onModelChange={onModelChange}
      onAction={popouts.onAction}
      onPopoutOpen={popouts.onOpen}
      onPopoutClose={popouts.onClose}
      popoutURL="/popout.html"
      i18nTranslator={(key) => {
        const word = WORDS.get(key) ?? key;
        return i18n.exists(`frame:${word}`) ? t(word) : word;
      }}
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
