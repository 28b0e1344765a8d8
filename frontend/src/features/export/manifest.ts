/** Returns the packages that a `package.xml` depends on, sorted, each once. */
export function dependenciesOf(manifest: string): string[] {
  const document = new DOMParser().parseFromString(manifest, 'application/xml');
  const found = [...document.querySelectorAll('depend, exec_depend')].map(
    (element) => element.textContent?.trim() ?? '',
  );
  return [...new Set(found.filter(Boolean))].sort();
}

/** The package names that ROS accepts. */
export const PACKAGE_NAME = /^[a-z][a-z0-9]*(_[a-z0-9]+)*$/;
