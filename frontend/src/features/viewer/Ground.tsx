import { useEffect, useMemo } from 'react';
import * as THREE from 'three';
import type { TextureCache } from './TextureCache';

const SIDE_M = 200;

interface GroundProps {
  readonly color: readonly number[];
  readonly isDark: boolean;
  readonly isSimple: boolean;
  /** Name of the picture on it, among `textures`. */
  readonly picture?: string | undefined;
  readonly textures?: TextureCache;
}

/** The endless floor at z = 0. */
export function Ground({ color, isDark, isSimple, picture, textures }: GroundProps) {
  const map = useMemo(() => groundPicture(textures, picture), [textures, picture]);
  useEffect(() => () => map?.dispose(), [map]);
  const shown = useMemo(() => {
    const [r = 0.8, g = 0.8, b = 0.8] = color;
    const ground = new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace);
    return isDark ? ground.multiplyScalar(0.2) : ground;
  }, [color, isDark]);
  return (
    <mesh receiveShadow position={[0, 0, -0.002]}>
      <planeGeometry args={[SIDE_M, SIDE_M]} />
      {isSimple ? (
        <meshLambertMaterial key={picture ?? ''} color={shown} map={map} />
      ) : (
        <meshStandardMaterial key={picture ?? ''} color={shown} map={map} roughness={0.95} metalness={0} />
      )}
    </mesh>
  );
}

/** The ground's picture, with a corner at the origin of the world. */
function groundPicture(textures?: TextureCache, name = ''): THREE.Texture | null {
  const [width, height] = textures?.tileOf(name) ?? [1, 1];
  const map = textures?.get(name)?.clone() ?? null;
  map?.repeat.set(SIDE_M / width, SIDE_M / height);
  map?.offset.set(-SIDE_M / 2 / width, -SIDE_M / 2 / height);
  return map;
}
