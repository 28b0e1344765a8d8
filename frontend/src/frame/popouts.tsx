import { Button, MantineThemeProvider } from '@mantine/core';
import { notifications } from '@mantine/notifications';
import { Actions, DockLocation, Model, TabNode, TabSetNode, type Action } from 'flexlayout-react';
import { useMemo, type ReactNode } from 'react';
import { bindShortcuts } from '@/commands/shortcuts';
import { t } from '@/i18n';
import { companionsOf, type PanelId } from '@/workspace/layoutModel';
import { useTabs } from '@/workspace/tabs';

/** Panels in windows of their own: each keeps where it came from, and goes back there when its window closes. */

interface Home {
  readonly tabset: string;
  readonly index: number;
}

const configOf = (tab: TabNode) => (tab.getConfig() as { home?: Home } | undefined) ?? {};

function tabsIn(model: Model, layoutId: string): TabNode[] {
  const found: TabNode[] = [];
  model.visitNodes((node) => {
    if (node instanceof TabNode && node.getLayoutId() === layoutId) found.push(node);
  });
  return found;
}

const titleOf = (tab: TabNode): string => t(`frame:${tab.getName()}`);

/** Opens a panel in a window of its own. */
export function popOut(panel: PanelId): void {
  const { model } = useTabs.getState();
  const tab = model?.getNodeById(panel);
  if (!model || !(tab instanceof TabNode)) return;
  if (tab.getLayoutId() === Model.MAIN_LAYOUT_ID) {
    rememberHome(model, panel);
    model.doAction(Actions.popoutTab(panel));
  } else tab.getWindow()?.focus();
}

function rememberHome(model: Model, id: string): void {
  const tab = model.getNodeById(id);
  const parent = tab?.getParent();
  if (!(tab instanceof TabNode) || !parent || tab.getLayoutId() !== Model.MAIN_LAYOUT_ID) return;
  const home: Home = { tabset: parent.getId(), index: parent.getChildren().indexOf(tab) };
  model.doAction(Actions.updateNodeAttributes(id, { config: { ...configOf(tab), home } }));
}

/** Where a panel goes back to: its place, or beside one of its kind when that place is gone. */
function placeFor(model: Model, tab: TabNode): Home | null {
  const { home } = configOf(tab);
  if (home && model.getNodeById(home.tabset) instanceof TabSetNode) return home;
  const beside = companionsOf(tab.getId() as PanelId)
    .map((id) => model.getNodeById(id))
    .find((node) => node instanceof TabNode && node.getLayoutId() === Model.MAIN_LAYOUT_ID);
  const tabset = beside?.getParent() ?? model.getFirstTabSet();
  return tabset ? { tabset: tabset.getId(), index: -1 } : null;
}

function giveBack(model: Model, tabs: readonly TabNode[]): void {
  for (const tab of tabs) {
    const place = placeFor(model, tab);
    if (!place) continue;
    model.doAction(Actions.moveNode(tab.getId(), place.tabset, DockLocation.CENTER, place.index, true));
  }
}

/** Notifies of blocked windows and offers to open them by a press, which browsers allow. */
function tellBlocked(tabs: readonly TabNode[]): void {
  const id = 'popout-blocked';
  const panels = tabs.map((tab) => tab.getId() as PanelId);
  notifications.show({
    id,
    color: 'yellow',
    autoClose: false,
    title: t('frame:popout.blocked', { panels: tabs.map(titleOf).join(', ') }),
    message: (
      <>
        {t('frame:popout.allow')}{' '}
        <Button
          size="compact-xs"
          variant="light"
          onClick={() => {
            notifications.hide(id);
            panels.forEach(popOut);
          }}
        >
          {t('frame:popout.again')}
        </Button>
      </>
    ),
  });
}

/** Follows the windows of one layout; its methods are what the docking library asks for. */
export class Popouts {
  private readonly open = new Map<string, () => void>();

  constructor(private readonly model: Model) {}

  /** Before an action of the user: a panel remembers its place, and a window that closes gives its panels back. */
  readonly onAction = (action: Action): Action | undefined => {
    if (action.type === Actions.POPOUT_TAB) rememberHome(this.model, String(action.data['node']));
    if (action.type !== Actions.CLOSE_POPOUT) return action;
    const layoutId = String(action.data['layoutId']);
    const tabs = tabsIn(this.model, layoutId);
    // A window that never opened was kept from it by the browser.
    if (!this.open.has(layoutId)) tellBlocked(tabs);
    giveBack(this.model, tabs);
    return undefined;
  };

  readonly onOpen = (layout: { getLayoutId(): string }, target: Window, page: Document): void => {
    const names = tabsIn(this.model, layout.getLayoutId()).map(titleOf);
    page.title = `${names.join(', ')} — BT Studio`;
    const followTheme = () => {
      const scheme = document.documentElement.getAttribute('data-mantine-color-scheme') ?? 'light';
      page.documentElement.setAttribute('data-mantine-color-scheme', scheme);
    };
    followTheme();
    const themed = new MutationObserver(followTheme);
    themed.observe(document.documentElement, { attributeFilter: ['data-mantine-color-scheme'] });
    const unbind = bindShortcuts(target);
    this.open.set(layout.getLayoutId(), () => {
      themed.disconnect();
      unbind();
    });
  };

  readonly onClose = (layout: { getLayoutId(): string }): void => {
    this.open.get(layout.getLayoutId())?.();
  };
}

/** Menus and tooltips of a panel come in the window that the panel is in. */
export function InItsWindow({ node, children }: { readonly node: TabNode; readonly children: ReactNode }) {
  const page = node.getWindow()?.document;
  const theme = useMemo(
    () =>
      page && page !== document ? { components: { Portal: { defaultProps: { target: page.body } } } } : {},
    [page],
  );
  return (
    <MantineThemeProvider inherit theme={theme}>
      {children}
    </MantineThemeProvider>
  );
}
