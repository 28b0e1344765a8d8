import { useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';
import type { DiagramNode } from '@/model/diagram';
import { fullName, typePortOf, type InterfaceField } from '@/model/rosFields';

/** Returns the installed interfaces that a ROS block can use; null for other blocks. */
export function useInterfaceNames(type: string): readonly string[] | null {
  const typePort = typePortOf(type);
  const { data } = useQuery({
    queryKey: ['interfaces'],
    queryFn: api.interfaces,
    staleTime: Infinity,
    enabled: typePort !== null,
  });
  if (typePort === null) return null;
  return (data ?? []).filter(({ kind }) => kind === typePort.kind).map(({ name }) => name);
}

/** Returns the fields of the interface that a ROS block names; null if it is not installed. */
export function useInterfaceFields(node: DiagramNode): readonly InterfaceField[] | null {
  const typePort = typePortOf(node.type);
  const name = typePort && fullName(node.ports?.[typePort.port] ?? '', typePort.kind);
  const names = useInterfaceNames(node.type);
  const isInstalled = name !== null && (names ?? []).includes(name);
  const { data } = useQuery({
    queryKey: ['interface', name],
    queryFn: () => api.interfaceFields(name ?? ''),
    staleTime: Infinity,
    enabled: isInstalled,
  });
  return isInstalled ? (data ?? null) : null;
}
