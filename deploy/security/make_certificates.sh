#!/bin/bash
# Makes what DDS Security needs for sessions of palpate in which strangers hear and say nothing: an authority of your own,
# one identity for your machines, what it may do, and the DDS configuration that uses them.
#   deploy/security/make_certificates.sh DIR
# Then, on each PC with its own copy of DIR at the same place:
#   export CYCLONEDDS_URI=file://DIR/loopback.xml        one PC; for two, put the interface and the peer into a copy of it
# Keep DIR/authority_key.pem apart from the machines; who has it can let others in. Everything is valid for a year.
set -euo pipefail

fail() { echo "make_certificates: $*" >&2; exit 2; }

[ $# -eq 1 ] || fail "where to? Give a folder"
command -v openssl >/dev/null || fail "openssl is not installed (package openssl)"
base=$(cd "$(dirname "$0")/../cyclonedds" && pwd)/loopback.xml  # what sessions on one PC use
[ -e "$base" ] || fail "$base is missing"
mkdir -p "$1"
dir=$(cd "$1" && pwd)
[ ! -e "$dir/identity_key.pem" ] || fail "$dir: holds an identity already; give another folder"
umask 077
cd "$dir"

openssl ecparam -name prime256v1 -genkey -noout -out authority_key.pem
openssl req -x509 -new -key authority_key.pem -days 365 -subj "/O=palpate/CN=authority" -out authority.pem 2>/dev/null
openssl ecparam -name prime256v1 -genkey -noout -out identity_key.pem
openssl req -new -key identity_key.pem -subj "/O=palpate/CN=node" -out identity.csr 2>/dev/null
openssl x509 -req -in identity.csr -CA authority.pem -CAkey authority_key.pem -CAcreateserial -days 365 -out identity.pem 2>/dev/null
rm identity.csr

from=$(date --utc --date yesterday +%Y-%m-%dT%H:%M:%S)
to=$(date --utc --date "365 days" +%Y-%m-%dT%H:%M:%S)
cat >governance.xml <<XML
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="https://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_governance.xsd">
  <domain_access_rules><domain_rule>
    <domains><id_range><min>0</min><max>100</max></id_range></domains>
    <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
    <enable_join_access_control>true</enable_join_access_control>
    <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
    <liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
    <rtps_protection_kind>NONE</rtps_protection_kind>
    <topic_access_rules><topic_rule>
      <topic_expression>*</topic_expression>
      <enable_discovery_protection>true</enable_discovery_protection>
      <enable_liveliness_protection>true</enable_liveliness_protection>
      <enable_read_access_control>true</enable_read_access_control>
      <enable_write_access_control>true</enable_write_access_control>
      <metadata_protection_kind>NONE</metadata_protection_kind>
      <data_protection_kind>ENCRYPT</data_protection_kind>
    </topic_rule></topic_access_rules>
  </domain_rule></domain_access_rules>
</dds>
XML
cat >permissions.xml <<XML
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="https://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_permissions.xsd">
  <permissions><grant name="node">
    <subject_name>/O=palpate/CN=node</subject_name>
    <validity><not_before>$from</not_before><not_after>$to</not_after></validity>
    <allow_rule>
      <domains><id_range><min>0</min><max>100</max></id_range></domains>
      <publish><topics><topic>*</topic></topics></publish>
      <subscribe><topics><topic>*</topic></topics></subscribe>
    </allow_rule>
    <default>DENY</default>
  </grant></permissions>
</dds>
XML
for what in governance permissions; do
  openssl smime -sign -in $what.xml -text -out $what.p7s -signer authority.pem -inkey authority_key.pem
  rm $what.xml
done

plugins=$(dirname "$(find /usr/lib -name libdds_security_auth.so 2>/dev/null | head -n 1)")
[ -e "$plugins/libdds_security_auth.so" ] || fail "no libdds_security_auth.so below /usr/lib (package libddsc0debian)"
plugin() {  # LIBRARY NAME
  echo "<Library path=\"$plugins/$1\" initFunction=\"init_$2\" finalizeFunction=\"finalize_$2\"/>"
}
sed '/<\/Domain>/,$d' "$base" >loopback.xml
cat >>loopback.xml <<XML
    <Security>
      <Authentication>
        $(plugin libdds_security_auth.so authentication)
        <IdentityCertificate>file:$dir/identity.pem</IdentityCertificate>
        <IdentityCA>file:$dir/authority.pem</IdentityCA>
        <PrivateKey>file:$dir/identity_key.pem</PrivateKey>
      </Authentication>
      <Cryptographic>
        $(plugin libdds_security_crypto.so crypto)
      </Cryptographic>
      <AccessControl>
        $(plugin libdds_security_ac.so access_control)
        <Governance>file:$dir/governance.p7s</Governance>
        <PermissionsCA>file:$dir/authority.pem</PermissionsCA>
        <Permissions>file:$dir/permissions.p7s</Permissions>
      </AccessControl>
    </Security>
  </Domain>
</CycloneDDS>
XML
echo "export CYCLONEDDS_URI=file://$dir/loopback.xml"
