import { Actions, DockLocation, TabNode, TabSetNode, type Model } from 'flexlayout-react';
import { furtherPanel } from './layoutModel';
import { useTabs } from './tabs';

interface CameraConfig {
  readonly camera?: string;
}

/** Returns the camera that was chosen for a view; null if none was chosen. */
export const cameraOf = (view: TabNode): string | null =>
  (view.getConfig() as CameraConfig | undefined)?.camera ?? null;

/** Stores the camera of a view in the layout. */
export function chooseCamera(view: TabNode, camera: string): void {
  const config = { ...(view.getConfig() as CameraConfig | undefined), camera };
  view.getModel().doAction(Actions.updateNodeAttributes(view.getId(), { config }));
}

/** Opens another camera view below an existing one, in the same window. */
export function openCameraBelow(view: TabNode, camera: string | null): void {
  const model = view.getModel();
  const config = camera === null ? {} : { config: { camera } };
  const tab = { ...furtherPanel('camera', freeId(model)), ...config };
  const place = view.getParent();
  if (place instanceof TabSetNode) {
    const { width } = useTabs.getState();
    // Where the panels share one row of tabs, there is no room for two pictures above each other.
    const where = width === 'narrow' ? DockLocation.CENTER : DockLocation.BOTTOM;
    model.doAction(Actions.addTab(tab, place.getId(), where, -1, true));
  }
}

/** Opens another camera view below the first one. */
export function openAnotherCamera(): void {
  const view = useTabs.getState().model?.getNodeById('camera');
  if (view instanceof TabNode) openCameraBelow(view, null);
}

function freeId(model: Model): string {
  let number = 2;
  while (model.getNodeById(`camera:${number}`)) number += 1;
  return `camera:${number}`;
}
