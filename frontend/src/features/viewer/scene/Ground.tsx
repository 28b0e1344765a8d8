import { useEffect, useMemo, useState } from 'react';
import * as THREE from 'three';
import type { Pictures } from './TextureCache';

const SIDE_M = 200;

interface GroundProps {
  readonly color: readonly number[];
  readonly isDark: boolean;
  readonly isSimple: boolean;
  /** The name of the ground's texture in `textures`. */
  readonly picture?: string | undefined;
  readonly textures?: Pictures;
}

/** The unlimited floor at z = 0. */
export function Ground({ color, isDark, isSimple, picture, textures }: GroundProps) {
  const map = useGroundPicture(textures, picture);
  const shown = useMemo(() => {
    const [r = 0.8, g = 0.8, b = 0.8] = color;
    const ground = new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace);
    return isDark ? ground.multiplyScalar(0.2) : ground;
  }, [color, isDark]);
  return (
    <mesh receiveShadow position={[0, 0, -0.002]}>
      <planeGeometry args={[SIDE_M, SIDE_M]} />
      {isSimple ? (
        <meshLambertMaterial key={map?.uuid ?? ''} color={shown} map={map} />
      ) : (
        <meshStandardMaterial key={map?.uuid ?? ''} color={shown} map={map} roughness={0.95} metalness={0} />
      )}
    </mesh>
  );
}

/** Returns the ground's texture, with a corner at the origin of the world; null until it arrives. */
function useGroundPicture(textures?: Pictures, name = ''): THREE.Texture | null {
  const [map, setMap] = useState<THREE.Texture | null>(null);
  useEffect(() => {
    let own: THREE.Texture | null = null;
    let isOver = false;
    textures?.whenLoaded(name, (texture) => {
      if (isOver) return;
      const [width, height] = textures.tileOf(name);
      own = texture.clone();
      own.repeat.set(SIDE_M / width, SIDE_M / height);
      own.offset.set(-SIDE_M / 2 / width, -SIDE_M / 2 / height);
      setMap(own);
    });
    return () => {
      isOver = true;
      own?.dispose();
      setMap(null);
    };
  }, [textures, name]);
  return map;
}
