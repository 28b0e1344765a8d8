import { useEffect, useLayoutEffect, useMemo, useReducer } from 'react';
import { Picture3d, PictureStage } from '@/features/editor3d/scene/Picture3d';
import { rgba } from '@/features/editor3d/scene/ThingScene';
import { isSoftwareWebGl } from '@/features/viewer/webgl';
import { readUniverse } from '@/model/universe/read';
import type { Universe } from '@/model/universe/types';
import { useFileText } from '@/store/saving/large';
import { EditorTextures, pictureName } from './textures';
import { UniverseScene } from './UniverseScene';

/** A picture of a universe of the project; nothing if the page cannot read it. */
export function UniversePicture({ path }: { readonly path: string }) {
  const text = useFileText(path) ?? '';
  const universe = useMemo(() => readUniverse(text).universe, [text]);
  if (!universe) return null;
  return (
    <Picture3d
      label={universe.name}
      near={0.05}
      stage={(isDark) => <Stage universe={universe} isDark={isDark} />}
    />
  );
}

function Stage({ universe, isDark }: { readonly universe: Universe; readonly isDark: boolean }) {
  const [arrivals, arrive] = useReducer((count: number) => count + 1, 0);
  const { scene, textures } = useMemo(() => {
    const pictures = new EditorTextures(arrive, 1);
    return {
      textures: pictures,
      scene: new UniverseScene(isSoftwareWebGl(), arrive, pictures),
    };
  }, []);
  useLayoutEffect(() => scene.showUniverse(universe), [scene, universe]);
  useEffect(() => () => scene.dispose(), [scene]);
  const { color, texture, tile } = universe.ground;
  return (
    <PictureStage
      scene={scene}
      request={arrivals}
      isDark={isDark}
      lights={universe.lights.map(({ direction, intensity }) => ({ direction: [...direction], intensity }))}
      ground={{ color: rgba(color), picture: pictureName(texture, tile) }}
      textures={textures}
      reach={[0.4, 80]}
      extent={[2.5, 40]}
    />
  );
}
