import { useThree } from '@react-three/fiber';
import { useEffect, useMemo } from 'react';
import * as THREE from 'three';
import { useMeasuring } from '../measuring';

const COLOR = 0xd6336c;
const DOT_PX = 9;

/** The measured points with the line between them; objects never hide them. */
export function MeasureLine() {
  const points = useMeasuring((state) => state.points);
  const invalidate = useThree((state) => state.invalidate);
  const geometry = useMemo(
    () =>
      new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(points.flat(), 3)),
    [points],
  );
  useEffect(() => {
    invalidate();
    return () => geometry.dispose();
  }, [geometry, invalidate]);
  if (points.length === 0) return null;
  return (
    <group renderOrder={3}>
      <points geometry={geometry} frustumCulled={false}>
        <pointsMaterial color={COLOR} size={DOT_PX} sizeAttenuation={false} depthTest={false} />
      </points>
      <lineSegments geometry={geometry} frustumCulled={false}>
        <lineBasicMaterial color={COLOR} depthTest={false} />
      </lineSegments>
    </group>
  );
}
