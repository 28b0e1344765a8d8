import { useMemo } from 'react';
import * as THREE from 'three';
import type { Scene } from '@/generated/messages';

interface LightsProps {
  readonly scene: Pick<Scene, 'lights'>;
  readonly bounds: THREE.Box3;
  readonly isDark: boolean;
  readonly hasShadows: boolean;
}

const SHADOW_MAP = 2048;

/** The world's own lights, the light of the sky, and soft shadows over the whole room. */
export function Lights({ scene, bounds, isDark, hasShadows }: LightsProps) {
  const size = Math.min(Math.max(bounds.getSize(new THREE.Vector3()).length() / 2, 4), 20);
  const lights = useMemo(
    () => (scene.lights.length > 0 ? scene.lights : [{ direction: [0.3, 0.4, -0.8], intensity: 1 }]),
    [scene],
  );
  return (
    <>
      <hemisphereLight
        args={[isDark ? '#b9c6e6' : '#ffffff', isDark ? '#2a2d36' : '#b9b4aa', isDark ? 0.9 : 1.35]}
        position={[0, 0, 1]}
      />
      {lights.map(({ direction: [x = 0.3, y = 0.4, z = -0.8], intensity }, index) => (
        <directionalLight
          key={index}
          position={new THREE.Vector3(-x, -y, -z).normalize().multiplyScalar(size * 2)}
          intensity={intensity * (isDark ? 1.5 : 2)}
          castShadow={hasShadows && index === 0}
          shadow-mapSize={[SHADOW_MAP, SHADOW_MAP]}
          shadow-bias={-0.0004}
          shadow-normalBias={0.02}
          shadow-radius={5}
        >
          <orthographicCamera attach="shadow-camera" args={[-size, size, size, -size, 0.1, size * 5]} />
        </directionalLight>
      ))}
    </>
  );
}
