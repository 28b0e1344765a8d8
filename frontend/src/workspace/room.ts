import { Actions, Orientation, TabNode, TabSetNode, type Model } from 'flexlayout-react';
import type { PanelId } from './layoutModel';

/** The height in px, with the bar of tabs, that panels get when they are shown first. */
const ROOM: Partial<Record<PanelId, number>> = { evaluate: 340, topics: 270, lesson: 360 };
/** The height in px that what lies above or below keeps. */
const KEPT_PX = 160;

/** What the layout has of a panel: whether it had its height once. */
interface Config {
  readonly hasRoom?: boolean;
}

/**
 * Gives the panels that are shown for the first time in a layout the height that they need, at the cost of the
 * highest neighbour in their column. From then on their height is the user's.
 */
export function giveRoom(model: Model): void {
  if (model.getMaximizedTabset()) return;
  for (const [id, wanted] of Object.entries(ROOM)) {
    const tab = model.getNodeById(id);
    const set = tab?.getParent();
    if (!(tab instanceof TabNode && set instanceof TabSetNode) || set.getSelectedNode() !== tab) continue;
    if ((tab.getConfig() as Config | undefined)?.hasRoom) continue;
    const column = set.getParent();
    const parts = column?.getChildren() ?? [];
    const heights = parts.map((part) => part.getRect().height);
    // Nothing is measured before the layout is drawn.
    if (!column || heights.some((height) => height <= 0)) continue;
    model.doAction(Actions.updateNodeAttributes(id, { config: { hasRoom: true } }));
    const own = parts.indexOf(set);
    const highest = heights.indexOf(Math.max(...heights.filter((_, at) => at !== own)));
    const most = (heights[highest] ?? 0) - KEPT_PX;
    const taken = Math.min(wanted - (heights[own] ?? wanted), most);
    if (taken <= 0 || column.getOrientation() !== Orientation.VERT) continue;
    const whole = heights.reduce((sum, height) => sum + height, 0);
    const weights = heights.map((height, at) => height + (at === own ? taken : at === highest ? -taken : 0));
    model.doAction(
      Actions.adjustWeights(
        column.getId(),
        weights.map((weight) => (100 * weight) / whole),
      ),
    );
  }
}
