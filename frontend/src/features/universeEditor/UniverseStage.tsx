import { useEffect, useMemo } from 'react';
import { EditorStage } from '@/features/editor3d/scene/EditorStage';
import { GHOST_OPACITY } from '@/features/editor3d/scene/PlacingTool';
import { rgba } from '@/features/editor3d/scene/ThingScene';
import { useThrottledInvalidate } from '@/features/viewer/useThrottledInvalidate';
import { isSoftwareWebGl } from '@/features/viewer/webgl';
import type { Universe } from '@/model/universe/types';
import { dragHandlerOf, wallDrawing } from './dragging';
import type { UniverseEditor } from './editor';
import { handlesOf } from './handles';
import { placementOf } from './placement';
import { EditorTextures, pictureName } from './textures';
import { UniverseScene } from './UniverseScene';
import { WallLine } from './WallLine';

interface UniverseStageProps {
  readonly editor: UniverseEditor;
  readonly universe: Universe;
  readonly isDark: boolean;
}

/** The content of a universe's 3D view, with the tools that move its things. */
export function UniverseStage({ editor, universe, isDark }: UniverseStageProps) {
  const isSimple = isSoftwareWebGl();
  const redraw = useThrottledInvalidate();
  const textures = useMemo(() => new EditorTextures(redraw, isSimple ? 1 : 8), [redraw, isSimple]);
  const scene = useMemo(() => new UniverseScene(isSimple, redraw, textures), [isSimple, redraw, textures]);
  const ghost = useMemo(
    () => new UniverseScene(isSimple, redraw, new EditorTextures(redraw, 1), GHOST_OPACITY),
    [isSimple, redraw],
  );
  const wall = useMemo(() => new WallLine(), []);
  const staged = useMemo(
    () => ({
      scene,
      handles: handlesOf(editor, scene),
      dragHandler: dragHandlerOf(editor, scene),
      placement: placementOf(editor, ghost),
      drawing: wallDrawing(editor, wall),
    }),
    [editor, scene, ghost, wall],
  );
  useEffect(
    () => () => {
      scene.dispose();
      ghost.dispose();
      wall.dispose();
    },
    [scene, ghost, wall],
  );
  const lights = useMemo(
    () => universe.lights.map(({ direction, intensity }) => ({ direction: [...direction], intensity })),
    [universe],
  );
  const { color, texture, tile } = universe.ground;
  return (
    <EditorStage
      editor={editor}
      staged={staged}
      content={universe}
      isDark={isDark}
      lights={lights}
      ground={{ color: rgba(color), picture: pictureName(texture, tile) }}
      textures={textures}
      reach={[0.4, 80]}
      extent={[2.5, 40]}
    >
      <primitive object={wall.group} />
    </EditorStage>
  );
}
