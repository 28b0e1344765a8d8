import { Button, MantineThemeProvider } from '@mantine/core';
import { notifications } from '@mantine/notifications';
import { Actions, DockLocation, Model, TabNode, TabSetNode, type Action } from 'flexlayout-react';
import { useMemo, type ReactNode } from 'react';
import { bindShortcuts } from '@/commands/shortcuts';
import { t } from '@/i18n';
import { companionsOf, type PanelId } from '@/workspace/layoutModel';
import { useTabs } from '@/workspace/tabs';

/**
 * Panels in windows of their own. A panel's place in the dock is recorded, and the panel returns there when
 * its window closes.
 */

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

/** Returns the title of a panel's tab. */
export const titleOf = (tab: TabNode): string => t(`frame:${tab.getName()}`);

/** Opens a panel in its own window. */
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

/**
 * Returns the place for a panel that leaves its window: its old place, or beside a similar panel if the old
 * place is gone.
 */
function placeFor(model: Model, tab: TabNode): Home | null {
  const { home } = configOf(tab);
  if (home && model.getNodeById(home.tabset) instanceof TabSetNode) return home;
  const beside = companionsOf(tab.getComponent() as PanelId)
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

/**
 * Notifies the user of blocked windows and offers a button to open them, since browsers always allow a window
 * after a press.
 */
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

/** The windows of one layout; its methods are callbacks of the docking library. */
export class Popouts {
  private readonly open = new Map<string, () => void>();

  constructor(private readonly model: Model) {}

  /**
   * Runs before each action of the user: records the place of a panel that gets a window, and returns the
   * panels of a window that closes.
   */
  readonly onAction = (action: Action): Action | undefined => {
    if (action.type === Actions.POPOUT_TAB) rememberHome(this.model, String(action.data['node']));
    if (action.type !== Actions.CLOSE_POPOUT) return action;
    const layoutId = String(action.data['layoutId']);
    const tabs = tabsIn(this.model, layoutId);
    // The browser blocked the window, which is why it never opened.
    if (!this.open.has(layoutId)) tellBlocked(tabs);
    giveBack(this.model, tabs);
    return undefined;
  };

  readonly onOpen = (layout: { getLayoutId(): string }, target: Window, page: Document): void => {
    const follow = () => {
      const { lang } = document.documentElement;
      const scheme = document.documentElement.getAttribute('data-mantine-color-scheme') ?? 'light';
      const names = tabsIn(this.model, layout.getLayoutId()).map(titleOf);
      page.title = `${names.join(', ')} — BT Studio`;
      page.documentElement.lang = lang;
      page.documentElement.setAttribute('data-mantine-color-scheme', scheme);
    };
    follow();
    // It is in a window already: the button that opens one is hidden there (`dock.css`).
    page.documentElement.dataset['panelWindow'] = '';
    const followed = new MutationObserver(follow);
    followed.observe(document.documentElement, { attributeFilter: ['data-mantine-color-scheme', 'lang'] });
    const unbind = bindShortcuts(target);
    this.open.set(layout.getLayoutId(), () => {
      followed.disconnect();
      unbind();
    });
  };

  readonly onClose = (layout: { getLayoutId(): string }): void => {
    this.open.get(layout.getLayoutId())?.();
  };
}

/** The context of a panel's content: menus and tooltips appear in the window that contains the panel. */
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
