import { useMemo } from 'react';
import * as THREE from 'three';

interface GroundProps {
  readonly color: readonly number[];
  readonly isDark: boolean;
  readonly isSimple: boolean;
}

/** The endless floor at z = 0. */
export function Ground({ color, isDark, isSimple }: GroundProps) {
  const shown = useMemo(() => {
    const [r = 0.8, g = 0.8, b = 0.8] = color;
    const ground = new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace);
    return isDark ? ground.multiplyScalar(0.2) : ground;
  }, [color, isDark]);
  return (
    <mesh receiveShadow position={[0, 0, -0.002]}>
      <planeGeometry args={[200, 200]} />
      {isSimple ? (
        <meshLambertMaterial color={shown} />
      ) : (
        <meshStandardMaterial color={shown} roughness={0.95} metalness={0} />
      )}
    </mesh>
  );
}
