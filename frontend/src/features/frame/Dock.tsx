import { Layout, type Action, type ITabRenderValues, type Model, type TabNode } from 'flexlayout-react';
import { IconFileCode, IconFileText, IconGitFork, IconHistory } from '@tabler/icons-react';
import { useEffect, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import 'flexlayout-react/style/light.css';
import './dock.css';
import { useProjectStore } from '@/store/project';
import { forgetLayouts, keepLayout, type FrameWidth } from './layoutModel';
import { renderTab } from './panels';
import { PanelBadge } from './PanelBadge';
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

/** The panels, docked as the user likes them. */
export function Dock({ model, width }: DockProps) {
  const { t, i18n } = useTranslation('frame');
  const keeping = useRef<ReturnType<typeof setTimeout>>(undefined);
  useEffect(() => () => clearTimeout(keeping.current), []);

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
      i18nTranslator={(key) => (i18n.exists(`frame:${key}`) ? t(key) : key)}
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
