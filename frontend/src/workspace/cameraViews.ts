import { Actions, DockLocation, TabNode, TabSetNode, type Model } from 'flexlayout-react';
import { furtherPanel } from './layoutModel';
import { useTabs } from './tabs';

interface CameraConfig {
  readonly camera?: string;
}

/** Returns the camera that was chosen for a view; null as long as none was. */
export const cameraOf = (view: TabNode): string | null =>
  (view.getConfig() as CameraConfig | undefined)?.camera ?? null;

/** Stores the camera of a view in the layout. */
export function chooseCamera(view: TabNode, camera: string): void {
  const config = { ...(view.getConfig() as CameraConfig | undefined), camera };
  view.getModel().doAction(Actions.updateNodeAttributes(view.getId(), { config }));
}

/** Opens one more view of cameras below another one, in the same window. */
export function openCameraBelow(view: TabNode, camera: string | null): void {
  const model = view.getModel();
  const config = camera === null ? {} : { config: { camera } };
  const tab = { ...furtherPanel('camera', freeId(model)), ...config };
  const place = view.getParent();
  if (place instanceof TabSetNode) {
    const { width } = useTabs.getState();
    // Two pictures do not fit above each other where the panels share one row of tabs.
    const where = width === 'narrow' ? DockLocation.CENTER : DockLocation.BOTTOM;
    model.doAction(Actions.addTab(tab, place.getId(), where, -1, true));
  }
}

/** Opens one more view of cameras beside the first one. */
export function openAnotherCamera(): void {
  const view = useTabs.getState().model?.getNodeById('camera');
  if (view instanceof TabNode) openCameraBelow(view, null);
}

function freeId(model: Model): string {
  let number = 2;
  while (model.getNodeById(`camera:${number}`)) number += 1;
  return `camera:${number}`;
}
