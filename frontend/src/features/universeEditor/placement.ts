import type { Placement } from '@/features/editor3d/scene/PlacingTool';
import { positionOf } from '@/model/universe/geometry';
import { placeThing, thingToPlace, type Placeable } from './commands';
import type { UniverseEditor } from './editor';
import type { UniverseScene } from './UniverseScene';

/** Places things in a universe; `scene` draws the ghost. */
export function placementOf(editor: UniverseEditor, scene: UniverseScene): Placement {
  return {
    scene,
    draw: (what) => {
      const thing = what ? thingToPlace(editor, what as Placeable) : undefined;
      scene.show(thing ? [thing] : []);
      scene.mark(thing ? [thing.key] : []);
      return thing ? { at: positionOf(thing), height: 0 } : null;
    },
    place: (what, at) => placeThing(editor, what as Placeable, at),
  };
}
